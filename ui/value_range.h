#pragma once

namespace tessera {

/// What the first and the last of the false colours stand for.
struct ValueRange {
    float low = 0;
    float high = 1;           ///< > low
    bool logarithmic = false; ///< colours stand for powers; low > 0

    /// Where a value lies: 0 at `low`, 1 at `high`, beyond them below and above.
    float share(float value) const;
    /// The value that lies there.
    float value(float share) const;

    /// The range after its low or high end was dragged by a share of the legend's length. Stays in order.
    ValueRange with_low_dragged(float by) const;
    ValueRange with_high_dragged(float by) const;

    bool operator==(const ValueRange&) const = default;
};

} // namespace tessera
