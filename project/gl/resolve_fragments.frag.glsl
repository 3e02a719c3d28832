// Sorts a pixel's segments by depth and blends them front to back.

#include "fragment_lists.glsl"

layout(location = 0) out vec4 result;

void swap(int a, int b) {
  float depth = depths[a];
  depths[a] = depths[b];
  depths[b] = depth;
  vec4 light = fragments[a];
  fragments[a] = fragments[b];
  fragments[b] = light;
}

// Lets the segment at `root` of the heap of `count` from `first` on sink to its place: deeper ones are above.
void sink(int first, int root, int count) {
  for (;;) {
    int child = 2 * root + 1;
    if (child >= count) return;
    if (child + 1 < count && depths[first + child + 1] > depths[first + child]) ++child;
    if (!(depths[first + child] > depths[first + root])) return;
    swap(first + root, first + child);
    root = child;
  }
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  int count = int(imageLoad(counts, pixel).x);
  int first = int(imageLoad(firsts, pixel).x);
  for (int root = count / 2 - 1; root >= 0; --root) sink(first, root, count);
  for (int last = count - 1; last > 0; --last) {
    swap(first, first + last);
    sink(first, 0, last);
  }
  vec4 sum = vec4(0);
  for (int i = first; i < first + count; ++i) sum += (1 - sum.a) * fragments[i];
  result = sum;
}
