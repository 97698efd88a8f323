/* tcc_variables.c - the C library's variables, as libtcc is given them.
 *
 * Debian's libtcc is an archive for programs: its code takes for granted that stdout, stderr and
 * environ lie near it, which holds in no shared library. The Makefile renames them in the copy
 * that is linked in, to these, which do. */
#include "backend.h"

extern char **environ;

FILE *tcc_stdout, *tcc_stderr;
char **tcc_environ;

void tcc_take_variables(void)
{
    tcc_stdout = stdout;
    tcc_stderr = stderr;
    tcc_environ = environ;
}
