/* ray_lanes.h - vectors of RAY_LANES floats and halves of as many doubles. Private.
 *
 * GNU vector types, so one text serves every level; the few intrinsics are where the compilers do
 * not find the instruction themselves.
 */
#ifndef BATTEN_RAY_LANES_H
#define BATTEN_RAY_LANES_H

#include <stdbool.h>
#include <stdint.h>
#if defined __x86_64__
#include <immintrin.h>
#endif

#define LANES RAY_LANES
#define HALF  (RAY_LANES / 2)

typedef float vf __attribute__((vector_size(4 * LANES)));
typedef int32_t vi __attribute__((vector_size(4 * LANES)));
typedef double vd __attribute__((vector_size(8 * HALF)));
typedef int64_t vl __attribute__((vector_size(8 * HALF)));
typedef float hf __attribute__((vector_size(4 * HALF))); /* half of a vf */
typedef int32_t hi __attribute__((vector_size(4 * HALF)));

#define INLINE static inline __attribute__((always_inline))

INLINE bool any(vi m)
{
#if LANES == 16 && defined __AVX512F__
	return _mm512_test_epi32_mask((__m512i)m, (__m512i)m) != 0;
#elif LANES == 8 && defined __AVX__
	return !_mm256_testz_si256((__m256i)m, (__m256i)m);
#elif LANES == 4 && defined __SSE2__
	return _mm_movemask_ps((__m128)m) != 0;
#else
	int32_t r = 0;

	for (int i = 0; i < LANES; i++)
		r |= m[i];
	return r != 0;
#endif
}

INLINE bool any_half(vl m)
{
#if LANES == 16 && defined __AVX512F__
	return _mm512_test_epi64_mask((__m512i)m, (__m512i)m) != 0;
#elif LANES == 8 && defined __AVX__
	return !_mm256_testz_si256((__m256i)m, (__m256i)m);
#elif LANES == 4 && defined __SSE2__
	return _mm_movemask_ps((__m128)m) != 0;
#else
	int64_t r = 0;

	for (int i = 0; i < HALF; i++)
		r |= m[i];
	return r != 0;
#endif
}

INLINE vf fill(float x)
{
	return x - (vf){ 0 };
}

INLINE vd filld(double x)
{
	return x - (vd){ 0 };
}

INLINE vf pick(vi m, vf a, vf b)
{
	return (vf)((m & (vi)a) | (~m & (vi)b));
}

INLINE vd pickd(vl m, vd a, vd b)
{
	return (vd)((m & (vl)a) | (~m & (vl)b));
}

/* Two halves as one, without a way round through memory. */
#if LANES == 16
#define JOIN(a, b)                                                                                 \
	__builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15)
#elif LANES == 8
#define JOIN(a, b) __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7)
#else
#define JOIN(a, b) __builtin_shufflevector(a, b, 0, 1, 2, 3)
#endif

INLINE vf to_float(const vd x[2])
{
	return JOIN(__builtin_convertvector(x[0], hf), __builtin_convertvector(x[1], hf));
}

INLINE vi to_mask(const vl x[2])
{
	return JOIN(__builtin_convertvector(x[0], hi), __builtin_convertvector(x[1], hi));
}

INLINE vf size(vf a)
{
	return (vf)((vi)a & 0x7fffffff);
}

INLINE vd sized(vd a)
{
	return (vd)((vl)a & INT64_MAX);
}

INLINE vf larger(vf a, vf b)
{
	return pick(a > b, a, b);
}

INLINE vf smaller(vf a, vf b)
{
	return pick(a < b, a, b);
}

INLINE int first_lane(vi m)
{
#if LANES == 16 && defined __AVX512F__
	return __builtin_ctz(_mm512_test_epi32_mask((__m512i)m, (__m512i)m));
#elif LANES == 8 && defined __AVX__
	return __builtin_ctz((unsigned)_mm256_movemask_ps((__m256)m));
#else
	int i = 0;

	while (i < LANES - 1 && !m[i])
		i++;
	return i;
#endif
}

/* Smallest of the lanes m; infinite if there are none. */
INLINE float lanes_least(vi m, vf a)
{
	vf b = pick(m, a, fill(__builtin_inff()));
#if LANES == 16 && defined __AVX512F__
	return _mm512_reduce_min_ps((__m512)b);
#else
	float x = b[0];

	for (int i = 1; i < LANES; i++)
		x = b[i] < x ? b[i] : x;
	return x;
#endif
}

#endif
