/* unit.h - what the unit tests check with. A program calls CHECK… and ends with `return
 * unit_done();`, which prints the line `N passed, N failed`. */
#ifndef UNIT_H
#define UNIT_H

#include <math.h>
#include <stdio.h>
#include <string.h>

static unsigned unit_passed, unit_failed;

static inline void unit_count(int holds, const char *what, const char *file, int line)
{
    unit_passed += holds != 0;
    unit_failed += holds == 0;
    if (!holds)
        printf("not ok %s:%d: %s\n", file, line, what);
}

static inline void unit_text(const char *found, const char *expected, const char *what,
                             const char *file, int line)
{
    int same = found && expected ? strcmp(found, expected) == 0 : found == expected;
    unit_count(same, what, file, line);
    if (!same)
        printf("    found    %s\n    expected %s\n", found ? found : "(none)",
               expected ? expected : "(none)");
}

static inline void unit_integer(long long found, long long expected, const char *what,
                                const char *file, int line)
{
    unit_count(found == expected, what, file, line);
    if (found != expected)
        printf("    found    %lld\n    expected %lld\n", found, expected);
}

static inline void unit_number(double found, double expected, const char *what, const char *file,
                               int line)
{
    int same = !(found < expected) && !(found > expected) && !isnan(found);
    unit_count(same, what, file, line);
    if (!same)
        printf("    found    %.17g\n    expected %.17g\n", found, expected);
}

static inline void unit_part(const char *found, const char *part, const char *what,
                             const char *file, int line)
{
    int holds = found && strstr(found, part);
    unit_count(holds, what, file, line);
    if (!holds)
        printf("    found    %s\n    expected %s in it\n", found ? found : "(none)", part);
}

static inline int unit_done(void)
{
    printf("%u passed, %u failed\n", unit_passed, unit_failed);
    return unit_failed ? 1 : 0;
}

#define CHECK(holds)                unit_count((holds), #holds, __FILE__, __LINE__)
#define CHECK_TEXT(found, expected) unit_text((found), (expected), #found, __FILE__, __LINE__)
#define CHECK_INTEGER(found, expected)                                                             \
    unit_integer((long long)(found), (expected), #found, __FILE__, __LINE__)
#define CHECK_NUMBER(found, expected)                                                              \
    unit_number((double)(found), (double)(expected), #found, __FILE__, __LINE__)
#define CHECK_PART(found, part) unit_part((found), (part), #found, __FILE__, __LINE__)

#endif
