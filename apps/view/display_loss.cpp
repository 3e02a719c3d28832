#include "apps/view/display_loss.h"

#include <cstdio>
#include <cstdlib>

#include <X11/Xlib.h>

namespace tetraglass::apps::view {

void end_with_the_display() {
  XSetIOErrorHandler([](Display*) -> int {
    std::fputs("tetraglass: error: the display is gone, and the window with it\n", stderr);
    std::fflush(nullptr);
    std::_Exit(1);
  });
}

}  // namespace tetraglass::apps::view
