/* stack.h - how much of a thread's stack is left: graphs that encapsulate themselves use it up. */
#ifndef PCG_STACK_H
#define PCG_STACK_H

#include <stddef.h>
#include <stdint.h>

/* The address that the stack of this thread, which grows down, must not pass if `reserve` bytes are
 * to be left; 1 where the system does not say. */
uintptr_t stack_floor(size_t reserve);
/* Where the stack is now. */
uintptr_t stack_here(void);

#endif
