/* digest.c - a hash of 128 bits, for telling contents apart: two chains of a 64-bit mixer, which
 * meet only at the end. It is no defence against whoever wants two contents to look alike. */
#include <string.h>

#include "base.h"

static uint64_t mixed(uint64_t a, uint64_t b)
{
    uint64_t x = a * 0x9E3779B97F4A7C15u + b + 0xD1B54A32D192ED03u;
    x ^= x >> 27;
    x *= 0x3C79AC492BA7B653u;
    x ^= x >> 33;
    x *= 0x1C69B3F74AC4AE35u;
    return x ^ x >> 27;
}

static void add_word(digest *d, uint64_t word)
{
    d->word[0] = mixed(d->word[0], word);
    d->word[1] = mixed(d->word[1] ^ 0x5851F42D4C957F2Du, ~word);
}

void digest_add(digest *d, const void *bytes, size_t count)
{
    const char *at = bytes;
    add_word(d, count);
    for (; count >= 8; at += 8, count -= 8) {
        uint64_t word;
        memcpy(&word, at, 8);
        add_word(d, word);
    }
    uint64_t rest = 0;
    if (count)
        memcpy(&rest, at, count);
    add_word(d, rest);
}

void digest_add_text(digest *d, const char *s)
{
    digest_add(d, s ? s : "", s ? strlen(s) : 0);
}

void digest_write(const digest *d, char out[DIGEST_TEXT])
{
    static const char digits[] = "0123456789abcdef";
    for (int i = 0; i < 32; i++)
        out[i] = digits[d->word[i / 16] >> (60 - 4 * (i % 16)) & 15];
    out[32] = '\0';
}
