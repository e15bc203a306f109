/** Hot loops are compiled for several processors; the loader picks the best one in an installed
 * binary. Off with sanitizers, whose run time is not ready when the loader asks. */
#ifndef HD_MULTIVERSION_H
#define HD_MULTIVERSION_H

#if defined(__x86_64__) && defined(__GNUC__) && !defined(HD_NO_MULTIVERSION)
#if __has_attribute(target_clones) /* clang has it since 14 */
#define HD_MULTIVERSION __attribute__((target_clones("avx512f", "fma", "default")))
#endif
#endif

#ifndef HD_MULTIVERSION
#define HD_MULTIVERSION
#endif

/** For functions written for registers of one size: HD_FOR compiles a function for processors that
 * have them, HD_HAS says whether this processor does. Elsewhere neither is defined. */
#if defined(__x86_64__) && defined(__GNUC__)
#define HD_FOR(processors) __attribute__((target(processors)))
#define HD_HAS(registers) __builtin_cpu_supports(registers)
#endif

#endif
