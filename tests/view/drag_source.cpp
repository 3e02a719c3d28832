#include "tests/view/drag_source.h"

#include <array>
#include <chrono>
#include <memory>
#include <thread>

#include <X11/Xatom.h>
#include <X11/Xlib.h>

namespace tetraglass::tests {
namespace {

constexpr long kVersion = 5;  // of the protocol

/// The side that drags, as a client of its own of the X server.
class DragSource {
 public:
  explicit DragSource(Display* display)
      : display_(display),
        root_(DefaultRootWindow(display)),
        window_(XCreateSimpleWindow(display, root_, 0, 0, 1, 1, 0, 0, 0)) {}

  std::string drop(const std::string& title, const std::string& uri_list);

 private:
  [[nodiscard]] Atom atom(const char* name) const { return XInternAtom(display_, name, False); }
  [[nodiscard]] Window find(Window parent, const std::string& title) const;
  void send(Window target, const char* type, const std::array<long, 4>& rest);
  bool wait_for(const char* type, XEvent& event, const std::string& uri_list);
  void answer(const XSelectionRequestEvent& request, const std::string& uri_list);

  Display* display_;
  Window root_;
  Window window_;
};

Window DragSource::find(Window parent, const std::string& title) const {
  char* name = nullptr;
  const bool named = XFetchName(display_, parent, &name) != 0;
  const bool found = named && title == name;
  if (named) XFree(name);
  if (found) return parent;
  Window ignored = 0;
  Window* children = nullptr;
  unsigned count = 0;
  if (XQueryTree(display_, parent, &ignored, &ignored, &children, &count) == 0) return 0;
  Window result = 0;
  for (unsigned i = 0; i < count && result == 0; ++i) result = find(children[i], title);
  if (children != nullptr) XFree(children);
  return result;
}

void DragSource::send(Window target, const char* type, const std::array<long, 4>& rest) {
  XEvent event{};
  event.xclient.type = ClientMessage;
  event.xclient.display = display_;
  event.xclient.window = target;
  event.xclient.message_type = atom(type);
  event.xclient.format = 32;
  event.xclient.data.l[0] = static_cast<long>(window_);
  for (std::size_t i = 0; i < rest.size(); ++i) event.xclient.data.l[i + 1] = rest[i];
  XSendEvent(display_, target, False, NoEventMask, &event);
  XFlush(display_);
}

/// The list itself, which the target asks for.
void DragSource::answer(const XSelectionRequestEvent& request, const std::string& uri_list) {
  XChangeProperty(display_, request.requestor, request.property, request.target, 8, PropModeReplace,
                  reinterpret_cast<const unsigned char*>(uri_list.data()),
                  static_cast<int>(uri_list.size()));
  XEvent notice{};
  notice.xselection.type = SelectionNotify;
  notice.xselection.requestor = request.requestor;
  notice.xselection.selection = request.selection;
  notice.xselection.target = request.target;
  notice.xselection.property = request.property;
  notice.xselection.time = request.time;
  XSendEvent(display_, request.requestor, False, NoEventMask, &notice);
  XFlush(display_);
}

bool DragSource::wait_for(const char* type, XEvent& event, const std::string& uri_list) {
  const Atom wanted = atom(type);
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (std::chrono::steady_clock::now() < end) {
    while (XPending(display_) > 0) {
      XNextEvent(display_, &event);
      if (event.type == SelectionRequest) answer(event.xselectionrequest, uri_list);
      if (event.type == ClientMessage && event.xclient.message_type == wanted) return true;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

std::string DragSource::drop(const std::string& title, const std::string& uri_list) {
  const Window target = find(root_, title);
  if (target == 0) return "no window is named " + title;
  XWindowAttributes place{};
  XGetWindowAttributes(display_, target, &place);
  const Atom selection = atom("XdndSelection");
  XSetSelectionOwner(display_, selection, window_, CurrentTime);
  const auto type = static_cast<long>(atom("text/uri-list"));
  send(target, "XdndEnter", {kVersion << 24, type, 0, 0});
  const long middle = (static_cast<long>(place.x + place.width / 2) << 16) |
                      static_cast<long>(place.y + place.height / 2);
  const auto copy = static_cast<long>(atom("XdndActionCopy"));
  send(target, "XdndPosition", {0, middle, CurrentTime, copy});
  XEvent event{};
  if (!wait_for("XdndStatus", event, uri_list)) return "the window says nothing to what is dragged";
  if ((event.xclient.data.l[1] & 1) == 0) return "the window does not take files";
  send(target, "XdndDrop", {0, CurrentTime, 0, 0});
  if (!wait_for("XdndFinished", event, uri_list)) return "the window did not take the list";
  return "";
}

}  // namespace

std::string drop_on_window(const std::string& display, const std::string& title,
                           const std::string& uri_list) {
  const std::unique_ptr<Display, decltype(&XCloseDisplay)> opened(XOpenDisplay(display.c_str()),
                                                                  &XCloseDisplay);
  if (!opened) return "no display " + display;
  return DragSource(opened.get()).drop(title, uri_list);
}

}  // namespace tetraglass::tests
