/* Lists of joint values: see model.rs. Vectors: see six_axes/vector.rs */

/* The lesser and the greater of two numbers; the other one where one is NaN. */
GB_INLINE gb_real gb_arm_min(gb_real a, gb_real b)
{
    return b < a || a != a ? b : a;
}

GB_INLINE gb_real gb_arm_max(gb_real a, gb_real b)
{
    return b > a || a != a ? b : a;
}

/* The number limited to 0 to 1. */
GB_INLINE gb_real gb_arm_share(gb_real share)
{
    return gb_arm_min(gb_arm_max(share, R(0.0)), R(1.0));
}

GB_INLINE gb_real gb_arm_dot(const gb_real *a, const gb_real *b)
{
    gb_real sum = R(0.0);
    GB_UNROLL
    for (int i = 0; i < GB_MOST_ARM_JOINTS; i++) {
        sum += a[i] * b[i];
    }
    return sum;
}

GB_INLINE gb_real gb_arm_norm(const gb_real *a)
{
    return gb_square_root(gb_arm_dot(a, a));
}

/* Writes `a + factor b` to `sum`, which may be one of them. */
GB_INLINE void gb_arm_plus(const gb_real *a, gb_real factor, const gb_real *b, gb_real *sum)
{
    GB_UNROLL
    for (int i = 0; i < GB_MOST_ARM_JOINTS; i++) {
        sum[i] = a[i] + factor * b[i];
    }
}

GB_INLINE void gb_arm_reverse(gb_real *a)
{
    GB_UNROLL
    for (int i = 0; i < GB_MOST_ARM_JOINTS; i++) {
        a[i] = -a[i];
    }
}

GB_INLINE void gb_arm_copy(const gb_real *a, gb_real *out)
{
    memcpy(out, a, GB_MOST_ARM_JOINTS * sizeof *a);
}

/* The largest magnitude of an entry. */
GB_INLINE gb_real gb_arm_largest(const gb_real *list, int count)
{
    gb_real largest = R(0.0);
    for (int i = 0; i < count; i++) {
        largest = gb_arm_max(largest, gb_magnitude(list[i]));
    }
    return largest;
}

GB_INLINE gb_real gb_arm_farthest(const gb_real *d)
{
    return gb_arm_largest(d, GB_MOST_ARM_JOINTS);
}

/* Sum and difference of vectors, and a vector times a factor. The output may be one of the inputs. */
GB_INLINE void gb_arm_add(const gb_real *a, const gb_real *b, gb_real *out)
{
    GB_UNROLL
    for (int i = 0; i < 3; i++) {
        out[i] = a[i] + b[i];
    }
}

GB_INLINE void gb_arm_sub(const gb_real *a, const gb_real *b, gb_real *out)
{
    GB_UNROLL
    for (int i = 0; i < 3; i++) {
        out[i] = a[i] - b[i];
    }
}

GB_INLINE void gb_arm_scale(const gb_real *a, gb_real factor, gb_real *out)
{
    GB_UNROLL
    for (int i = 0; i < 3; i++) {
        out[i] = a[i] * factor;
    }
}

/* The bit of a joint. */
GB_INLINE uint32_t gb_arm_bit(size_t joint)
{
    return (uint32_t)1 << joint;
}
