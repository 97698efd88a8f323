/* stack.c - how much of a thread's stack is left. */
#define _GNU_SOURCE /* pthread_getattr_np */
#include "stack.h"

#include <pthread.h>

uintptr_t stack_floor(size_t reserve)
{
    uintptr_t floor = 1;
#if defined(__linux__) && defined(__GLIBC__)
    pthread_attr_t attributes;
    void *lowest;
    size_t size;
    if (pthread_getattr_np(pthread_self(), &attributes))
        return floor;
    if (pthread_attr_getstack(&attributes, &lowest, &size) == 0)
        floor = (uintptr_t)lowest + (reserve < size / 2 ? reserve : size / 2);
    pthread_attr_destroy(&attributes);
#else
    (void)reserve;
#endif
    return floor;
}

uintptr_t stack_here(void)
{
    return (uintptr_t)__builtin_frame_address(0);
}
