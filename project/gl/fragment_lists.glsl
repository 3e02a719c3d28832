// The segments of the pixels of a patch: those of one pixel lie side by side, from the pixel's first on.

layout(early_fragment_tests) in;  // pixels that are not wanted get nothing

layout(binding = 0, r32ui) uniform uimage2D counts;            // gathered so far
layout(binding = 1, r32ui) readonly uniform uimage2D firsts;
layout(binding = 0, std430) buffer Depths { float depths[]; };
layout(binding = 1, std430) buffer Lights { vec4 fragments[]; };  // associated color and opacity
