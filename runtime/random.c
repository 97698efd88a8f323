/* random.c - hashing, and the random numbers that are made of it.
 *
 * A random number is a function of where it is drawn and for whom; there is no generator whose
 * state an edit elsewhere could move on. Both formulas are part of what a seed means: changed,
 * every city changes.
 */
#include "run.h"

/* a * K + b maps each b, for one a, to another word (and each a, for one b); the second constant
 * keeps small numbers from meeting at 0. What follows is a bijection in which every bit of the sum
 * reaches every bit of the result: Stafford's scheme with the constants of moremur. */
pcg_u64 pcg_mix(pcg_u64 a, pcg_u64 b)
{
    pcg_u64 x = a * 0x9E3779B97F4A7C15u + b + 0xD1B54A32D192ED03u;
    x ^= x >> 27;
    x *= 0x3C79AC492BA7B653u;
    x ^= x >> 33;
    x *= 0x1C69B3F74AC4AE35u;
    x ^= x >> 27;
    return x;
}

/* The upper 53 bits of mix(mix(mix(key, lineage), site), i), as a fraction. */
double pcg_random(const pcg_call *c, pcg_u32 site, pcg_u64 i)
{
    c->run->drawn = true;
    pcg_u64 bits = pcg_mix(pcg_mix(pcg_mix(c->key, c->lineage), site), i);
    return (double)(bits >> 11) * 0x1p-53;
}
