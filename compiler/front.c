/* front.c - the front end: from a source to an ordered program. */
#include "compiler.h"

static void lap(const compilation *c, const char *pass)
{
    if (c->lap)
        c->lap(c->user, pass);
}

program *compile_front(compilation *c, const source *main)
{
    program *p = resolve(c, main);
    lap(c, "resolve");
    if (!p)
        return NULL;
    bool sound = check(c, p);
    lap(c, "check");
    if (!sound)
        return p;
    order(c, p);
    lap(c, "order");
    return p;
}
