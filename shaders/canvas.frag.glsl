#version 330 core
// Shows an image of radiance (exposure, then sRGB), of gradients (+/- colours), or of numbers (false colours) in a
// pane.

uniform sampler2D image;
uniform ivec2 pane_size;    // pixels
uniform vec2 image_origin;  // top left corner of the image in the pane, pixels from the pane's top left
uniform vec2 image_extent;  // size of the image in the pane, pixels
uniform float gain;         // 2^exposure; false colours: 1 / top value
uniform int colour_map;     // 0: radiance, or one of those below
uniform vec3 false_colours[9]; // display colours of 0 to the top value, evenly spaced
uniform bool is_coarse;     // a first look at a fraction of the size: interpolate
uniform vec3 background;    // display colour around the image

out vec4 colour;

const int signed_difference = 1; // gradients: the luminance's sign becomes a hue
const int false_colour = 2;      // numbers: red alone counts
const vec3 nan_colour = vec3(1.0, 0.0, 1.0);
const vec3 infinity_colour = vec3(0.0, 1.0, 1.0);
const vec3 zero_colour = vec3(0.10, 0.10, 0.11);
const vec3 plus_colour = vec3(1.00, 0.66, 0.20);
const vec3 minus_colour = vec3(0.26, 0.62, 1.00);
const int most_taps = 6; // an axis, where a pane's pixel covers several of the image

float srgb(float c) { return c <= 0.0031308 ? 12.92 * c : 1.055 * pow(c, 1.0 / 2.4) - 0.055; }

// By bits: compilers may take isnan() to be false.
bool is_nan(float v) { return (floatBitsToUint(v) & 0x7fffffffu) > 0x7f800000u; }
bool is_infinite(float v) { return (floatBitsToUint(v) & 0x7fffffffu) == 0x7f800000u; }
bool any_nan(vec3 v) { return is_nan(v.r) || is_nan(v.g) || is_nan(v.b); }
bool any_infinite(vec3 v) { return is_infinite(v.r) || is_infinite(v.g) || is_infinite(v.b); }

float luminance(vec3 c) { return dot(c, vec3(0.212671, 0.715160, 0.072169)); }

// What is shown of a value before the display's curve: in [0, 1], signed in [-1, 1]. Averages are taken of this,
// so that one bright pixel does not outshine its neighbours when the image is shrunk.
vec3 exposed(vec3 value) {
    return colour_map == signed_difference ? vec3(clamp(luminance(value) * gain, -1.0, 1.0))
                                           : clamp(value * gain, 0.0, 1.0);
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
    return vec3(srgb(value.r), srgb(value.g), srgb(value.b));
}

// The image's pixels that the pane's pixel covers, or the one that it lies in.
vec3 covered(vec2 from, vec2 to, ivec2 size, out bool has_nan, out bool has_infinity) {
    ivec2 taps = clamp(ivec2(ceil(to - from - 0.01)), ivec2(1), ivec2(most_taps));
    vec3 sum = vec3(0.0);
    has_nan = false;
    has_infinity = false;
    for (int y = 0; y < taps.y; ++y) {
        for (int x = 0; x < taps.x; ++x) {
            vec2 point = mix(from, to, (vec2(x, y) + 0.5) / vec2(taps));
            vec3 value = texelFetch(image, clamp(ivec2(floor(point)), ivec2(0), size - 1), 0).rgb;
            has_nan = has_nan || any_nan(value);
            has_infinity = has_infinity || any_infinite(value);
            sum += exposed(value);
        }
    }
    return sum / float(taps.x * taps.y);
}

void main() {
    vec2 pixel = vec2(gl_FragCoord.x, float(pane_size.y) - gl_FragCoord.y); // centre, from the top left
    vec2 where = (pixel - image_origin) / image_extent;
    colour = vec4(background, 1.0);
    if (any(lessThan(where, vec2(0.0))) || any(greaterThanEqual(where, vec2(1.0))))
        return;

    if (is_coarse) {
        vec3 value = texture(image, where).rgb;
        colour.rgb = displayed(exposed(value));
        if (any_infinite(value))
            colour.rgb = infinity_colour;
        if (any_nan(value))
            colour.rgb = nan_colour;
        return;
    }
    ivec2 size = textureSize(image, 0);
    vec2 to_image = vec2(size) / image_extent;
    vec2 from = (pixel - 0.5 - image_origin) * to_image;
    bool has_nan, has_infinity;
    vec2 span = max(to_image, vec2(0.0));
    vec3 value = all(lessThanEqual(span, vec2(1.0)))
                     ? covered(where * vec2(size), where * vec2(size), size, has_nan, has_infinity)
                     : covered(from, from + span, size, has_nan, has_infinity);
    colour.rgb = has_nan ? nan_colour : has_infinity ? infinity_colour : displayed(value);
}
