#include "experiment/trial.h"

#include "experiment/refresh.h"

#include <algorithm>

namespace obscura {

namespace {

constexpr std::size_t fingers = 32; // keys held down at once, and more

int planned(const Phase& phase, double refreshHz) {
    if (!phase.counted())
        return 0;
    return phase.frames > 0 ? phase.frames : maskRefreshes(phase.seconds, refreshHz);
}

int longest(const std::vector<Phase>& phases, double refreshHz) {
    int most = 0;
    for (const Phase& phase : phases)
        most = std::max(most, planned(phase, refreshHz));
    return most;
}

} // namespace

int optionOf(gl::Key key) {
    if (key == gl::Key::left || key == gl::Key::right)
        return key == gl::Key::left ? 1 : 2;
    const int digit = digitOf(key);
    return digit == 1 || digit == 2 ? digit : 0;
}

TrialMachine::TrialMachine(std::vector<Phase> phases, int images, double refreshHz, Keys keys)
    : phases_(std::move(phases)), refreshHz_(refreshHz), keys_(std::move(keys)),
      forms_(phases_.size()), count_(refreshHz, longest(phases_, refreshHz)) {
    record_.phases.resize(phases_.size());
    held_.reserve(fingers);
    const auto shows = [](const Phase& phase) { return !phase.images.empty(); };
    const auto first = std::find_if(phases_.begin(), phases_.end(), shows);
    const auto last = std::find_if(phases_.rbegin(), phases_.rend(), shows);
    firstImage_ = first == phases_.end() ? 0 : static_cast<Screen>(first - phases_.begin());
    lastImage_ = static_cast<Screen>(phases_.rend() - last) - 1;
    for (journalAt_ = firstImage_; journalAt_ > 0; --journalAt_)
        if (const Phase& before = phase(journalAt_ - 1);
            !before.counted() || !before.questions.empty())
            break;
    std::size_t questions = 0;
    for (std::size_t i = 0; i < phases_.size(); ++i) {
        PhaseRecord& record = record_.phases[i];
        record.framesPlanned = planned(phases_[i], refreshHz);
        record.intervals.reserve(static_cast<std::size_t>(record.framesPlanned));
        if (!phases_[i].questions.empty())
            forms_[i].emplace(phases_[i].questions, images, keys_);
        questions += phases_[i].questions.size();
    }
    record_.answers.reserve(questions);
}

TrialMachine::Next TrialMachine::next() const {
    if (left_)
        return Next::left;
    if (screen_ == static_cast<Screen>(phases_.size()))
        return Next::finished;
    if (screen_ == journalAt_ && !journalled_)
        return Next::journal;
    return pending_ || counted(screen_) ? Next::present : Next::wait;
}

bool TrialMachine::counted(std::optional<Screen> screen) const {
    return screen && *screen != leaveScreen && phase(*screen).counted();
}

bool TrialMachine::locked(std::optional<Screen> screen) const {
    return screen && *screen != leaveScreen && phase(*screen).locked();
}

bool TrialMachine::exposing(Screen screen) const {
    return screen >= firstImage_ && screen <= lastImage_;
}

const Form* TrialMachine::form() const {
    const auto index = static_cast<std::size_t>(screen_);
    return screen_ != leaveScreen && index < forms_.size() && forms_[index] ? &*forms_[index]
                                                                            : nullptr;
}

Form* TrialMachine::asked() { return const_cast<Form*>(form()); }

int TrialMachine::alternation() const {
    const Phase& current = phase(screen_);
    const int each = maskRefreshes(current.alternate, refreshHz_);
    const int shown = record_.phases[static_cast<std::size_t>(screen_)].framesShown;
    return shown / each % current.turns;
}

void TrialMachine::shown(double time) {
    if (visible_ != screen_)
        enter(time);
    pending_ = false;
    if (!counted(screen_))
        return;
    count_.add(time);
    noteCount();
    PhaseRecord& record = recordOf(screen_);
    if (record.framesShown < record.framesPlanned)
        return;
    if (form()) {
        record.timedOut = true;
        answer(Form::Effect::finished, time);
    } else {
        advance(time);
    }
}

void TrialMachine::enter(double time) {
    if (counted(visible_)) {
        count_.end(time);
        noteCount();
        std::vector<double>& all = recordOf(*visible_).intervals;
        all.insert(all.end(), count_.intervals().begin(), count_.intervals().end());
    }
    if (visible_ && *visible_ != leaveScreen)
        recordOf(*visible_).view += time - since_;
    before_ = visible_;
    visible_ = screen_;
    since_ = time;
    if (screen_ == leaveScreen)
        return;
    PhaseRecord& record = recordOf(screen_);
    framesBefore_ = record.framesShown;
    missedBefore_ = record.missedFrames;
    if (counted(screen_))
        count_.restart();
    if (!record.shown)
        record.onset = time;
    record.shown = true;
}

// Of the phase on the screen.
void TrialMachine::noteCount() {
    PhaseRecord& record = recordOf(*visible_);
    record.framesShown = framesBefore_ + count_.refreshes();
    record.missedFrames = missedBefore_ + count_.missed();
}

void TrialMachine::handle(const Event& event) {
    using Kind = Event::Kind;
    if (event.kind == Kind::release) {
        std::erase(held_, event.key);
        return;
    }
    if (event.kind == Kind::focusLost) {
        if (screen_ != leaveScreen && exposing(screen_))
            interrupt();
        return;
    }
    if (event.kind == Kind::press) {
        if (std::find(held_.begin(), held_.end(), event.key) != held_.end())
            return;
        held_.push_back(event.key);
    }
    if (next() == Next::finished || next() == Next::left)
        return;
    if (const auto phase = droppedIn(event.time)) {
        recordOf(*phase).earlyPresses += event.kind == Kind::press;
        return;
    }
    if (visible_ != screen_ || event.time < since_)
        return;
    if (event.kind == Kind::press)
        press(event.key, event.time);
    else if (screen_ == leaveScreen)
        leave(event.option);
    else if (Form* page = asked())
        answer(event.kind == Kind::text
                   ? page->type(event.symbol, viewed(screen_, event.time))
                   : page->click(event.option, event.share, viewed(screen_, event.time)),
               event.time);
    else if (event.kind == Kind::option && !phase(screen_).text.empty())
        end(event.time);
}

// The locked phase in which a key was pressed: from when the phase before was ended until the next
// one is on.
std::optional<Screen> TrialMachine::droppedIn(double time) const {
    if (locked(screen_))
        return screen_;
    if (locked(visible_))
        return visible_;
    if (locked(before_) && visible_ != leaveScreen && time < since_)
        return before_;
    return std::nullopt;
}

void TrialMachine::press(gl::Key key, double time) {
    if (key == gl::Key::escape)
        askToLeave();
    else if (screen_ == leaveScreen)
        leave(optionOf(key));
    else if (Form* page = asked())
        answer(page->press(key, viewed(screen_, time)), time);
    else if (keys_.isGo(static_cast<int>(key)) && phase(screen_).key)
        end(time);
}

void TrialMachine::end(double time) {
    if (viewed(screen_, time) < phase(screen_).atLeast)
        ++recordOf(screen_).hastyPresses;
    else
        advance(time);
}

void TrialMachine::answer(Form::Effect effect, double time) {
    pending_ |= effect == Form::Effect::changed;
    if (effect != Form::Effect::finished)
        return;
    const std::vector<FormAnswer> given = form()->answers();
    record_.answers.insert(record_.answers.end(), given.begin(), given.end());
    advance(time);
}

void TrialMachine::leave(int option) {
    left_ = option == 2;
    if (option == 1 || option == 2)
        go(paused_);
}

void TrialMachine::askToLeave() {
    if (screen_ == leaveScreen) {
        go(paused_);
        return;
    }
    if (exposing(screen_))
        interrupt();
    paused_ = screen_;
    go(leaveScreen);
}

void TrialMachine::interrupt() {
    recordOf(screen_).interrupted = true;
    record_.interrupted = true;
}

void TrialMachine::advance(double time) {
    if (screen_ + 1 == static_cast<Screen>(phases_.size()))
        recordOf(screen_).view = viewed(screen_, time);
    go(screen_ + 1);
}

void TrialMachine::go(Screen screen) {
    screen_ = screen;
    pending_ = true;
}

double TrialMachine::viewed(Screen screen, double time) const {
    const double now = visible_ == screen ? time - since_ : 0;
    return (screen == leaveScreen ? 0 : record_.phases[static_cast<std::size_t>(screen)].view) +
           now;
}

} // namespace obscura
