#include "tests/viewer/file_drag.h"

#include "base/error.h"

#include <X11/Xatom.h>
#include <X11/Xlib.h>

#include <initializer_list>
#include <string>

namespace obscura::test {

namespace {

constexpr long version = 5;

}

struct FileDrag::Sender {
    Display* display = XOpenDisplay(nullptr);
    Window own = 0, other = 0;
    std::string uris;
    int x = 0, y = 0;
    bool accepted = false, taken = false;

    Atom atom(const char* name) const { return XInternAtom(display, name, False); }

    // The window under the place, if it is one that files can be dropped on.
    Window under() const {
        Window root = DefaultRootWindow(display), child = 0;
        int ignored = 0;
        XTranslateCoordinates(display, root, root, x, y, &ignored, &ignored, &child);
        Atom type = 0;
        int format = 0;
        unsigned long count = 0, left = 0;
        unsigned char* data = nullptr;
        if (child)
            XGetWindowProperty(display, child, atom("XdndAware"), 0, 1, False, AnyPropertyType,
                               &type, &format, &count, &left, &data);
        if (data)
            XFree(data);
        return count == 1 ? child : 0;
    }

    void send(const char* message, std::initializer_list<long> values) {
        XEvent event{};
        event.xclient.type = ClientMessage;
        event.xclient.window = other;
        event.xclient.message_type = atom(message);
        event.xclient.format = 32;
        event.xclient.data.l[0] = static_cast<long>(own);
        int i = 1;
        for (const long value : values)
            event.xclient.data.l[i++] = value;
        XSendEvent(display, other, False, NoEventMask, &event);
        XFlush(display);
    }

    void answer(const XSelectionRequestEvent& request) {
        XChangeProperty(display, request.requestor, request.property, request.target, 8,
                        PropModeReplace, reinterpret_cast<const unsigned char*>(uris.data()),
                        static_cast<int>(uris.size()));
        XEvent event{};
        event.xselection.type = SelectionNotify;
        event.xselection.requestor = request.requestor;
        event.xselection.selection = request.selection;
        event.xselection.target = request.target;
        event.xselection.property = request.property;
        event.xselection.time = request.time;
        XSendEvent(display, request.requestor, False, NoEventMask, &event);
        XFlush(display);
    }

    void take(const XEvent& event) {
        if (event.type == SelectionRequest)
            answer(event.xselectionrequest);
        else if (event.type == ClientMessage && event.xclient.message_type == atom("XdndStatus") &&
                 (event.xclient.data.l[1] & 1) && !accepted) {
            accepted = true;
            send("XdndDrop", {0, CurrentTime});
        } else if (event.type == ClientMessage &&
                   event.xclient.message_type == atom("XdndFinished"))
            taken = event.xclient.data.l[1] != 0; // GLFW 3.3 says how many bytes it took
    }
};

FileDrag::FileDrag(const std::filesystem::path& file, int x, int y)
    : sender_(std::make_unique<Sender>()) {
    Sender& s = *sender_;
    if (!s.display)
        throw Error("expected an X server at DISPLAY, found none");
    s.x = x;
    s.y = y;
    s.uris = "file://" + std::filesystem::absolute(file).string() + "\r\n";
    s.own = XCreateSimpleWindow(s.display, DefaultRootWindow(s.display), 0, 0, 1, 1, 0, 0, 0);
    s.other = s.under();
    if (!s.other)
        throw Error("expected a window there on which files can be dropped (XdndAware)");
    XSetSelectionOwner(s.display, s.atom("XdndSelection"), s.own, CurrentTime);
    s.send("XdndEnter", {version << 24, static_cast<long>(s.atom("text/uri-list")), 0, 0});
    s.send("XdndPosition", {0, (static_cast<long>(x) << 16) | y, CurrentTime,
                            static_cast<long>(s.atom("XdndActionCopy"))});
}

FileDrag::~FileDrag() {
    if (sender_->display)
        XCloseDisplay(sender_->display);
}

bool FileDrag::serve() {
    while (XPending(sender_->display) > 0) {
        XEvent event;
        XNextEvent(sender_->display, &event);
        sender_->take(event);
    }
    return sender_->taken;
}

} // namespace obscura::test
