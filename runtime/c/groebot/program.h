/* Declarations of the program that follows in the robot's file */

typedef struct GB_(sink) GB_(sink);
GB_INLINE void GB_(parameters)(const T *target, T *p);
GB_UNUSED static void GB_(walk)(const T *p, GB_(sink) *c);
GB_INLINE void GB_(sizes)(const T *p, const T *at, T *sizes);
#ifdef GB_SHORTS
GB_INLINE void GB_(shorten)(const T *p, const T *at, T *value, T *size, T (*columns)[GB_SHORTS]);
#endif

/* The equations' values, zero at a solution. */
#ifdef GB_COMPARED
GB_INLINE void GB_(tip)(const T *at, T *tip);
GB_INLINE void GB_(values)(const T *p, const T *at, T *values)
{
    GB_(tip)(at, values);
    GB_UNROLL
    for (int i = 0; i < GB_EQUATIONS; i++) {
        values[i] = values[i] - p[gb_compared[i]];
    }
}
#else
GB_INLINE void GB_(values)(const T *p, const T *at, T *values);
#endif
