// Shows an image of radiance (exposure, then a tone curve), of gradients and differences (+/- colours), or of numbers
// (false colours) in a pane, or what has colours already. Before this text stand constants that say which
// (CanvasShader):
//     int colour_map      0: radiance, or one of those below
//     int sampling        0: the image's pixel that the pane's lies in, or `averaged`
//     bool is_difference  to a second image

uniform sampler2D image;
uniform ivec2 pane_size;    // pixels
uniform vec2 image_origin;  // top left corner of the image in the pane, pixels from the pane's top left
uniform vec2 image_extent;  // size of the image in the pane, pixels
uniform sampler2D subtrahend; // what a difference takes off, stretched over the image
uniform float gain;         // 2^exposure
uniform int tone_curve;     // 0: sRGB, or the one below
uniform vec2 range;         // the values that false colours begin and end with
uniform bool is_logarithmic; // false colours stand for powers
uniform vec3 false_colours[9]; // display colours of the range, evenly spaced
uniform bool marks_negative;
uniform vec3 background;    // display colour around the image

out vec4 colour;

const int signed_difference = 1; // gradients: the luminance's sign becomes a hue
const int false_colour = 2;      // numbers: red alone counts
const int direction = 3;         // -1 to 1 in each channel
const int own = 4;               // display colours
const int averaged = 1; // of all pixels of the image that the pane's covers
const int filmic_curve = 1;
const vec3 nan_colour = vec3(1.0, 0.0, 1.0);
const vec3 infinity_colour = vec3(0.0, 1.0, 1.0);
const vec3 negative_colour = vec3(0.15, 0.25, 1.0);
const vec3 zero_colour = vec3(0.10, 0.10, 0.11);
const vec3 plus_colour = vec3(1.00, 0.66, 0.20);
const vec3 minus_colour = vec3(0.26, 0.62, 1.00);
const int most_taps = 256; // an axis, where a pane's pixel covers several of the image: so many that none is missed

float srgb(float c) { return c <= 0.0031308 ? 12.92 * c : 1.055 * pow(c, 1.0 / 2.4) - 0.055; }

// ACES' reference transform, fitted by a fraction [Narkowicz 2015].
vec3 filmic(vec3 c) {
    c = max(c, 0.0);
    return clamp(c * (2.51 * c + 0.03) / (c * (2.43 * c + 0.59) + 0.14), 0.0, 1.0);
}

// By bits: compilers may take isnan() to be false.
bool is_nan(float v) { return (floatBitsToUint(v) & 0x7fffffffu) > 0x7f800000u; }
bool is_infinite(float v) { return (floatBitsToUint(v) & 0x7fffffffu) == 0x7f800000u; }
bool any_nan(vec3 v) { return is_nan(v.r) || is_nan(v.g) || is_nan(v.b); }
bool any_infinite(vec3 v) { return is_infinite(v.r) || is_infinite(v.g) || is_infinite(v.b); }

float luminance(vec3 c) { return dot(c, vec3(0.212671, 0.715160, 0.072169)); }

// What is shown of a value before the display's curve: in [0, 1], signed in [-1, 1]. Averages are taken of this,
// so that one bright pixel does not outshine its neighbours when the image is shrunk.
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

vec3 in_false_colour(float share) {
    float place = share * float(false_colours.length() - 1);
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

// What lies in a pixel of the image, that of a point outside in the nearest.
vec3 fetched(vec2 place, ivec2 size) {
    ivec2 point = clamp(ivec2(floor(place)), ivec2(0), size - 1);
    vec3 value = texelFetch(image, point, 0).rgb;
    if (!is_difference)
        return value;
    ivec2 other_size = textureSize(subtrahend, 0);
    ivec2 other = other_size == size ? point : ivec2((vec2(point) + 0.5) / vec2(size) * vec2(other_size));
    return value - texelFetch(subtrahend, other, 0).rgb;
}

// What was found among the pixels looked at.
struct Oddities {
    bool is_nan, is_infinite, is_negative;
};

void look(vec3 value, inout Oddities odd) {
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

// The image's pixels that a pixel of the pane covers, exposed.
vec3 average(vec2 from, vec2 to, ivec2 size, inout Oddities odd) {
    ivec2 taps = clamp(ivec2(ceil(to - from - 0.01)), ivec2(1), ivec2(most_taps));
    vec3 sum = vec3(0.0);
    for (int y = 0; y < taps.y; ++y) {
        for (int x = 0; x < taps.x; ++x) {
            vec2 point = mix(from, to, (vec2(x, y) + 0.5) / vec2(taps));
            vec3 value = fetched(point, size);
            look(value, odd);
            sum += exposed(value);
        }
    }
    return sum / float(taps.x * taps.y);
}

// What the image has for a pixel of the pane, exposed; `where` is its centre, as shares of the image.
vec3 sampled(vec2 pixel, vec2 where, inout Oddities odd) {
    ivec2 size = textureSize(image, 0);
    if (sampling == averaged) {
        vec2 to_image = vec2(size) / image_extent;
        vec2 from = (pixel - 0.5 - image_origin) * to_image;
        return average(from, from + to_image, size, odd);
    }
    vec3 value = fetched(where * vec2(size), size);
    look(value, odd);
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
