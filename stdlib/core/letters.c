/* letters.c - capital and small letters, by the ranges in which Unicode keeps them in pairs. */
#include "letters.h"

/* What letters_read returns for a byte that is no UTF-8: beyond all characters, so without a
 * case. */
enum { LETTERS_BYTE = 0x110000 };

pcg_u32 letters_read(const char *s, const char **end)
{
    static const pcg_u32 smallest[] = {0, 0, 0x80, 0x800, 0x10000};
    unsigned char first = (unsigned char)*s;
    int bytes = first < 0x80 ? 1 : first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : first >= 0xc0 ? 2 : 0;
    pcg_u32 letter = bytes == 1 ? first : first & (0x7fu >> bytes);
    *end = s + 1;
    for (int i = 1; i < bytes; i++) {
        unsigned char next = (unsigned char)s[i];
        if ((next & 0xc0) != 0x80) {
            return LETTERS_BYTE + first;
        }
        letter = letter << 6 | (next & 0x3f);
    }
    if (bytes == 0 || letter < smallest[bytes] || letter >= LETTERS_BYTE) {
        return LETTERS_BYTE + first;
    }
    *end = s + bytes;
    return letter;
}

size_t letters_write(pcg_u32 letter, char to[4])
{
    if (letter < 0x80) {
        to[0] = (char)letter;
        return 1;
    }
    size_t bytes = letter < 0x800 ? 2 : letter < 0x10000 ? 3 : 4;
    for (size_t i = bytes - 1; i > 0; i--) {
        to[i] = (char)(0x80 | (letter & 0x3f));
        letter >>= 6;
    }
    to[0] = (char)((0xf00 >> bytes) | letter);
    return bytes;
}

/* Capitals first … last, whose small letters are `apart` behind them; apart 1: capital and small
 * letter take turns, the first being a capital. */
typedef struct letters_range {
    pcg_u32 first, last, apart;
} letters_range;

static const letters_range ranges[] = {
    {'A', 'Z', 32},         {0x00c0, 0x00d6, 32},   {0x00d8, 0x00de, 32}, /* basic Latin, Latin-1 */
    {0x0100, 0x012e, 1},    {0x0132, 0x0136, 1},    {0x0139, 0x0147, 1},  /* extended Latin */
    {0x014a, 0x0176, 1},    {0x0179, 0x017d, 1},    {0x0386, 0x0386, 38}, /* Greek with accents */
    {0x0388, 0x038a, 37},   {0x038c, 0x038c, 64},   {0x038e, 0x038f, 63},
    {0x0391, 0x03a1, 32},   {0x03a3, 0x03ab, 32},   /* Greek */
    {0x0400, 0x040f, 80},   {0x0410, 0x042f, 32},   /* Cyrillic */
};

enum { LETTERS_RANGES = sizeof ranges / sizeof ranges[0] };

pcg_u32 letters_upper(pcg_u32 letter)
{
    for (int i = 0; i < LETTERS_RANGES; i++) {
        const letters_range *r = &ranges[i];
        pcg_u32 first = r->first + r->apart, last = r->last + r->apart;
        if (letter >= first && letter <= last && (r->apart > 1 || (letter - first) % 2 == 0)) {
            return letter - r->apart;
        }
    }
    return letter;
}

pcg_u32 letters_lower(pcg_u32 letter)
{
    for (int i = 0; i < LETTERS_RANGES; i++) {
        const letters_range *r = &ranges[i];
        if (letter >= r->first && letter <= r->last &&
            (r->apart > 1 || (letter - r->first) % 2 == 0)) {
            return letter + r->apart;
        }
    }
    return letter;
}
