#pragma once

namespace tetraglass::apps::view {

/// From now on, a connection to the X server that breaks ends the program with one line on stderr
/// and status 1, at once: no other thread is waited for.
void end_with_the_display();

}  // namespace tetraglass::apps::view
