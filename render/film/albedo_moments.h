#pragma once

namespace tessera {

/// Variance of the albedo, and covariance of albedo and value, within one sample that is the mean of several paths
/// or camera positions; both per channel.
template <class Color>
struct AlbedoSpread {
    Color variance{0}, covariance{0};
};

/// First and second moments of an albedo a and the value v that it demodulates: of a weighted mean, or sums over
/// samples. All are per channel.
template <class Color>
struct AlbedoMoments {
    Color value{0}, albedo{0};
    Color squares{0};  ///< of a^2
    Color products{0}; ///< of a v

    /// Adds one path with albedo a and value v.
    /// @param weight        weight of the albedo
    /// @param value_weight  weight of the value; differs from `weight` if paths have several camera positions
    void add(Color a, Color v, float weight, float value_weight) {
        value += v * value_weight;
        albedo += a * weight;
        squares += a * a * weight;
        products += a * v * value_weight;
    }
    /// Adds one sample to the sums.
    /// @param within  spread within the sample; 0 for a sample of one path
    void add(Color a, Color v, const AlbedoSpread<Color>& within) {
        value += v;
        albedo += a;
        squares += a * a + within.variance;
        products += a * v + within.covariance;
    }
    void operator+=(const AlbedoMoments& other) {
        value += other.value;
        albedo += other.albedo;
        squares += other.squares;
        products += other.products;
    }
    void operator*=(float factor) {
        value *= factor;
        albedo *= factor;
        squares *= factor;
        products *= factor;
    }

    template <class Number>
    void operator/=(Number n) {
        value /= n;
        albedo /= n;
        squares /= n;
        products /= n;
    }

    // These need means, not sums. Rounding can make the variance slightly negative.

    Color variance() const { return squares - albedo * albedo; }
    Color covariance() const { return products - albedo * value; }
    AlbedoSpread<Color> spread() const { return {variance(), covariance()}; }
};

} // namespace tessera
