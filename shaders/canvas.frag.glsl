// Displays an image in a pane: radiance (exposure, then a tone curve), gradients and differences (+/- colours), numbers
// (false colours), or display colours. CanvasShader puts these constants before this text:
//     int colour_map      0: radiance, or a constant below
//     int sampling        0: the nearest image pixel, or `averaged`
//     bool is_difference  to a second image

uniform sampler2D image;
uniform ivec2 pane_size;    // pixels
uniform vec2 image_origin;  // top left corner of the image in the pane, pixels from the pane's top left
uniform vec2 image_extent;  // size of the image in the pane, pixels
uniform sampler2D subtrahend; // second image of a difference, stretched over the first
uniform float gain;         // 2^exposure
uniform int tone_curve;     // 0: sRGB, or a constant below
uniform vec2 range;         // values of the first and last false colour
uniform bool is_logarithmic; // false colours are logarithmic
uniform vec3 false_colours[9]; // display colours, evenly spaced over the range
uniform bool marks_negative;
uniform vec3 background;    // display colour around the image

out vec4 colour;

const int signed_difference = 1; // gradients: a hue for each sign of the luminance
const int false_colour = 2;      // numbers in the red channel
const int direction = 3;         // directions: -1 to 1 in each channel
const int own = 4;               // display colours, shown unchanged
const int averaged = 1; // mean over the image pixels that a pane pixel covers
const int filmic_curve = 1;
const vec3 nan_colour = vec3(1.0, 0.0, 1.0);
const vec3 infinity_colour = vec3(0.0, 1.0, 1.0);
const vec3 negative_colour = vec3(0.15, 0.25, 1.0);
const vec3 zero_colour = vec3(0.10, 0.10, 0.11);
const vec3 plus_colour = vec3(1.00, 0.66, 0.20);
const vec3 minus_colour = vec3(0.26, 0.62, 1.00);
const int most_taps = 256; // samples along an axis when a pane pixel covers several image pixels

float srgb(float c) { return c <= 0.0031308 ? 12.92 * c : 1.055 * pow(c, 1.0 / 2.4) - 0.055; }

// Rational fit of the ACES reference transform [Narkowicz 2015].
vec3 filmic(vec3 c) {
    c = max(c, 0.0);
    return clamp(c * (2.51 * c + 0.03) / (c * (2.43 * c + 0.59) + 0.14), 0.0, 1.0);
}

// Tests bits, since compilers may assume that isnan() is false.
bool is_nan(float v) { return (floatBitsToUint(v) & 0x7fffffffu) > 0x7f800000u; }
bool is_infinite(float v) { return (floatBitsToUint(v) & 0x7fffffffu) == 0x7f800000u; }
bool any_nan(vec3 v) { return is_nan(v.r) || is_nan(v.g) || is_nan(v.b); }
bool any_infinite(vec3 v) { return is_infinite(v.r) || is_infinite(v.g) || is_infinite(v.b); }

float luminance(vec3 c) { return dot(c, vec3(0.212671, 0.715160, 0.072169)); }

// Returns a value before the display's curve: in [0, 1], or signed in [-1, 1]. Averages are taken after this, so that a
// bright pixel does not dominate when the image is shrunk.
vec3 exposed(vec3 value) {
    if (colour_map == false_colour) {
        float v = value.r;
        return vec3(clamp(is_logarithmic ? log(max(v, 1e-30) / range.x) / log(range.y / range.x)
                                         : (v - range.x) / (range.y - range.x), 0.0, 1.0));
    }
    if (colour_map == signed_difference)
        return vec3(clamp(luminance(value) * gain, -1.0, 1.0));
    if (colour_map == direction)
        return clamp(value * 0.5 + 0.5, 0.0, 1.0);
    if (colour_map == own)
        return clamp(value, 0.0, 1.0);
    return tone_curve == filmic_curve ? filmic(min(value * gain, 1e4)) : clamp(value * gain, 0.0, 1.0);
}

vec3 in_false_colour(float fraction) {
    float place = fraction * float(false_colours.length() - 1);
    int below = min(int(place), false_colours.length() - 2);
    return mix(false_colours[below], false_colours[below + 1], place - float(below));
}

vec3 displayed(vec3 value) {
    if (colour_map == false_colour)
        return in_false_colour(value.r);
    if (colour_map == signed_difference)
        return mix(zero_colour, value.r >= 0.0 ? plus_colour : minus_colour, srgb(abs(value.r)));
    if (colour_map == direction || colour_map == own)
        return value;
    return vec3(srgb(value.r), srgb(value.g), srgb(value.b));
}

bool is_marked_negative(vec3 v) {
    return marks_negative && colour_map == 0 && any(lessThan(v, vec3(0.0)));
}

// Returns the image pixel at a place in pixels, clamped to the image, minus the subtrahend there.
vec3 fetched(vec2 place, ivec2 size) {
    ivec2 point = clamp(ivec2(floor(place)), ivec2(0), size - 1);
    vec3 value = texelFetch(image, point, 0).rgb;
    if (!is_difference)
        return value;
    ivec2 other_size = textureSize(subtrahend, 0);
    ivec2 other = other_size == size ? point : ivec2((vec2(point) + 0.5) / vec2(size) * vec2(other_size));
    return value - texelFetch(subtrahend, other, 0).rgb;
}

// Invalid or negative values among the pixels read.
struct Oddities {
    bool is_nan, is_infinite, is_negative;
};

void note_oddities(vec3 value, inout Oddities odd) {
    odd.is_nan = odd.is_nan || any_nan(value);
    odd.is_infinite = odd.is_infinite || any_infinite(value);
    odd.is_negative = odd.is_negative || is_marked_negative(value);
}

vec3 marked(vec3 display_colour, Oddities odd) {
    return odd.is_nan        ? nan_colour
           : odd.is_infinite ? infinity_colour
           : odd.is_negative ? negative_colour
                             : display_colour;
}

// Returns the exposed mean over the image pixels in [from, to), which a pane pixel covers.
vec3 average(vec2 from, vec2 to, ivec2 size, inout Oddities odd) {
    ivec2 taps = clamp(ivec2(ceil(to - from - 0.01)), ivec2(1), ivec2(most_taps));
    vec3 sum = vec3(0.0);
    for (int y = 0; y < taps.y; ++y) {
        for (int x = 0; x < taps.x; ++x) {
            vec2 point = mix(from, to, (vec2(x, y) + 0.5) / vec2(taps));
            vec3 value = fetched(point, size);
            note_oddities(value, odd);
            sum += exposed(value);
        }
    }
    return sum / float(taps.x * taps.y);
}

// Returns the exposed image value for a pane pixel; `where` is its centre, as a fraction of the image.
vec3 sampled(vec2 pixel, vec2 where, inout Oddities odd) {
    ivec2 size = textureSize(image, 0);
    if (sampling == averaged) {
        vec2 to_image = vec2(size) / image_extent;
        vec2 from = (pixel - 0.5 - image_origin) * to_image;
        return average(from, from + to_image, size, odd);
    }
    vec3 value = fetched(where * vec2(size), size);
    note_oddities(value, odd);
    return exposed(value);
}

void main() {
    vec2 pixel = vec2(gl_FragCoord.x, float(pane_size.y) - gl_FragCoord.y); // centre, from the top left
    vec2 where = (pixel - image_origin) / image_extent;
    colour = vec4(background, 1.0);
    if (any(lessThan(where, vec2(0.0))) || any(greaterThanEqual(where, vec2(1.0))))
        return;
    Oddities odd = Oddities(false, false, false);
    vec3 value = sampled(pixel, where, odd);
    colour.rgb = marked(displayed(value), odd);
}
