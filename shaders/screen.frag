#version 450
// Shows a frame in a window, or one of its outputs.
#extension GL_GOOGLE_include_directive : require
#include "language.h"
#include "shared.h"
#include "patch_color.glsl"

// A pipeline for each of the ways: llvmpipe computes all branches for every pixel, also those that none of them takes.
layout(constant_id = CONSTANT_SCREEN) const uint SCREEN = SCREEN_PIXEL;
layout(push_constant) uniform PushBlock { ScreenPush push; };
layout(std430, binding = BINDING_COLOR) readonly restrict buffer ColorBlock { vec4 colors[]; };
layout(std430, binding = BINDING_AOVS) readonly restrict buffer AovsBlock { PixelAovs pixels[]; };

// The colours once more, in the texture's upper left corner, if the frame is no larger than the window: a texture
// interpolates faster than reads of the buffer.
layout(binding = BINDING_FRAME) uniform sampler2D texture_of_frame;

layout(location = 0) out vec4 shown;

uint index_of(uvec2 pixel) {
  return min(pixel.y, push.frame_height - 1u) * push.frame_width + min(pixel.x, push.frame_width - 1u);
}

// The transfer function of sRGB, IEC 61966-2-1.
vec3 linear_from_srgb(vec3 x) {
  return mix(x / 12.92, pow((x + 0.055) / 1.055, vec3(2.4)), greaterThan(x, vec3(0.04045)));
}
vec3 srgb_from_linear(vec3 x) {
  return mix(x * 12.92, 1.055 * pow(x, vec3(1.0 / 2.4)) - 0.055, greaterThan(x, vec3(0.0031308)));
}

// A colour scale for 0 <= t <= 1: dark blue, blue, green, yellow, red.
vec3 heat(float t) {
  vec3 low = mix(vec3(0.05, 0.05, 0.3), vec3(0.1, 0.45, 0.9), clamp(4.0 * t, 0.0, 1.0));
  vec3 middle = mix(low, vec3(0.2, 0.75, 0.3), clamp(4.0 * t - 1.0, 0.0, 1.0));
  vec3 high = mix(middle, vec3(0.95, 0.85, 0.2), clamp(4.0 * t - 2.0, 0.0, 1.0));
  return mix(high, vec3(0.85, 0.1, 0.1), clamp(4.0 * t - 3.0, 0.0, 1.0));
}

float on_scale(float x) { return clamp((x - push.low) / max(push.high - push.low, 1e-30), 0.0, 1.0); }

// The colour that shows an output of one pixel of the frame. Outputs other than colours are never averaged over pixels: the
// mean of normals or patch numbers has no meaning.
vec3 output_of(uint index) {
  if (push.shown == SHOWN_ERROR) {
    float error = colors[index].x;
    if (error == ERROR_NOTHING) return vec3(0.12);
    if (error == ERROR_UNDECIDED) return vec3(0.5);
    if (error == ERROR_WRONG) return vec3(1.0, 0.0, 1.0);
    return heat(on_scale(log(max(error, 1e-30)) / log(10.0)));
  }
  PixelAovs pixel = pixels[index];
  if (push.shown == SHOWN_EVALUATIONS) return heat(on_scale(float(pixel.evaluations)));
  if (pixel.triangle == NO_TRIANGLE) return vec3(0.12);
  if (push.shown == SHOWN_NORMAL) return 0.5 + 0.5 * pixel.normal_z.xyz;
  if (push.shown == SHOWN_GEOMETRIC) return 0.5 + 0.5 * pixel.geometric_u.xyz;
  if (push.shown == SHOWN_DEPTH) return vec3(1.0 - on_scale(pixel.normal_z.w));
  if (push.shown == SHOWN_PATCH) return patch_color(pixel.triangle);
  return vec3(pixel.geometric_u.w, pixel.v, 1.0 - pixel.geometric_u.w - pixel.v);
}

// The mean of `across` x `across` pixels of the frame from `first` on, computed in linear light.
vec3 mean_color(uvec2 first, uint across) {
  vec3 sum = vec3(0.0);
  for (uint row = 0u; row < across; ++row) {
    for (uint column = 0u; column < across; ++column) {
      sum += linear_from_srgb(colors[index_of(first + uvec2(column, row))].rgb);
    }
  }
  return srgb_from_linear(sum / float(across * across));
}

void main() {
  vec2 frame = vec2(push.frame_width, push.frame_height);
  vec2 position = gl_FragCoord.xy / vec2(push.width, push.height) * frame;
  if (SCREEN == SCREEN_OUTPUT) {
    shown = vec4(output_of(index_of(uvec2(position))), 1.0);
  } else if (SCREEN == SCREEN_MEAN) {
    uint across = push.frame_width / push.width;
    shown = vec4(mean_color(uvec2(gl_FragCoord.xy) * across, across), 1.0);
  } else if (SCREEN == SCREEN_PIXEL) {
    shown = texelFetch(texture_of_frame, ivec2(gl_FragCoord.xy), 0);
  } else {
    // The texture may be larger than the frame: clamping to the centres of the frame's outermost pixels keeps what lies
    // beyond them out of the interpolation.
    vec2 within = clamp(position, vec2(0.5), frame - 0.5);
    shown = texture(texture_of_frame, within / vec2(textureSize(texture_of_frame, 0)));
  }
}
