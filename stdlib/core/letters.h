/* letters.h - capital and small letters, without the C library's locales. */
#ifndef PCG_STDLIB_CORE_LETTERS_H
#define PCG_STDLIB_CORE_LETTERS_H

#include "core.h"

/* The character of UTF-8 that s begins with, which must not be the string's end; *end is set behind
 * it. A byte that is no UTF-8 stands for itself, as a character that has no case. */
pcg_u32 letters_read(const char *s, const char **end);
/* Writes a character as UTF-8; returns how many bytes it took. */
size_t letters_write(pcg_u32 letter, char to[4]);

/* The letter's counterpart, where it has one that is a single letter; else itself. Latin, Greek,
 * Cyrillic. */
pcg_u32 letters_upper(pcg_u32 letter);
pcg_u32 letters_lower(pcg_u32 letter);

#endif
