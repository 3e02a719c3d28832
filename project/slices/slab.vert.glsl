// A vertex of the outline of one slab of one block of the grid.

layout(location = 0) in vec2 position;
layout(location = 1) in vec2 slab_bounds;
#ifdef BLOCKS
layout(location = 2) in vec3 block_from;
layout(location = 3) in vec3 block_to;
#endif

flat out vec2 slab;
#ifdef BLOCKS
flat out vec3 block_low;
flat out vec3 block_high;
#endif

void main() {
  slab = slab_bounds;
#ifdef BLOCKS
  block_low = block_from;
  block_high = block_to;
#endif
  gl_Position = vec4(position, 0, 1);
}
