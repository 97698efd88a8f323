/* backend_tcc.c - libtcc, which is not reentrant: one compilation at a time, in the C locale.
 *
 * The lock, and the variables that libtcc is given behind it, are all in the compiler that is
 * written and hangs on no compilation: what it guards, libtcc's own variables, belongs to the
 * process. */
#include <libtcc.h>
#include <locale.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "backend.h"

static pthread_mutex_t tcc_lock = PTHREAD_MUTEX_INITIALIZER;

/* ---- complaints ------------------------------------------------------------------------------ */

void complain(complaint *c, const char *format, ...)
{
    va_list arguments, again;
    va_start(arguments, format);
    va_copy(again, arguments);
    int more = vsnprintf(NULL, 0, format, arguments);
    char *longer = more < 0 ? NULL : realloc(c->text, c->length + (size_t)more + 1);
    if (longer) {
        vsnprintf(longer + c->length, (size_t)more + 1, format, again);
        c->text = longer;
        c->length += (size_t)more;
    }
    va_end(again);
    va_end(arguments);
}

bool complain_to(complaint *c, char **error)
{
    if (error) {
        *error = c->text;
    } else {
        free(c->text);
    }
    return false;
}

/* ---- compiling ------------------------------------------------------------------------------- */

static void take_message(void *context, const char *message)
{
    complaint *c = context;
    complain(c, "%s%s", c->length ? "\n" : "", message);
}

static TCCState *state_new(const char *define, int output, complaint *c)
{
    TCCState *s = tcc_new();
    if (!s) {
        complain(c, "libtcc does not start");
        return NULL;
    }
    tcc_set_error_func(s, c, take_message);
    tcc_set_options(s, "-nostdlib -nostdinc");
    if (tcc_set_output_type(s, output) != 0) {
        complain(c, "libtcc refuses to make this kind of output");
        tcc_delete(s);
        return NULL;
    }
    if (define) {
        tcc_define_symbol(s, define, "1");
    }
    return s;
}

static bool compile(const char *c_text, const char *define, int output, complaint *c,
                    tcc_finish *finish, void *context, TCCState **keep)
{
    TCCState *s = state_new(define, output, c);
    if (!s) {
        return false;
    }
    bool done = tcc_compile_string(s, c_text) == 0 && finish(context, s, c);
    if (done && keep) {
        *keep = s;
    } else {
        tcc_delete(s);
    }
    return done;
}

bool tcc_compile(const char *c_text, const char *define, int output, complaint *c,
                 tcc_finish *finish, void *context, TCCState **keep)
{
    locale_t plain = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    if (plain == (locale_t)0) {
        complain(c, "out of memory");
        return false;
    }
    pthread_mutex_lock(&tcc_lock);
    locale_t before = uselocale(plain);
    tcc_take_variables();
    bool done = compile(c_text, define, output, c, finish, context, keep);
    uselocale(before);
    pthread_mutex_unlock(&tcc_lock);
    freelocale(plain);
    if (!done && !c->text) {
        complain(c, "libtcc failed without saying why");
    }
    return done;
}

void tcc_discard(TCCState *s)
{
    pthread_mutex_lock(&tcc_lock);
    tcc_delete(s);
    pthread_mutex_unlock(&tcc_lock);
}
