#include "experiment/data_folder.h"
#include "experiment/pages.h"
#include "experiment/presenter.h"

namespace obscura {

// The page before a session, which is the experimenter's.

namespace {

// The window's title says all that may change on the page.
std::string titleOf(const std::string& typed, const std::string& problem) {
    return "who takes part?" + (typed.empty() ? "" : " " + typed) +
           (problem.empty() ? "" : " - " + problem);
}

// Types or deletes one character; false for all other input.
bool edit(std::string& text, const gl::Input& input) {
    const bool typed =
        input.kind == gl::Input::Kind::text && input.symbol > 32 && input.symbol < 127;
    const bool deleted =
        input.kind == gl::Input::Kind::press && input.key == gl::Key::backspace && !text.empty();
    if (typed)
        text += static_cast<char>(input.symbol);
    if (deleted)
        text.pop_back();
    return typed || deleted;
}

} // namespace

Presenter::Sheet Presenter::startSheet(const StartFacts& start, const std::string& typed,
                                       const std::string& problem) const {
    return sheet(idPage(texts_, typed, problem, start), titleOf(typed, problem));
}

Presenter::Start Presenter::askId(const StartFacts& start,
                                  const std::function<IdVerdict(const std::string&)>& judge) {
    std::string typed, problem;
    Sheet page = startSheet(start, typed, problem);
    turnTo(page);
    for (;;) {
        const auto before = std::pair(typed, problem);
        for (const gl::Input& input : inputs()) {
            const bool press = input.kind == gl::Input::Kind::press;
            if (input.kind == gl::Input::Kind::close || (press && input.key == gl::Key::escape))
                return {};
            if (press && input.key == gl::Key::tab && start.monitors)
                return {std::nullopt, true};
            if (press && input.key == gl::Key::enter) {
                const IdVerdict verdict = judge(typed);
                const bool confirmed = verdict.broken && goesOn(*verdict.broken);
                if (confirmed || (verdict.accepted && !verdict.broken))
                    return {typed, false};
                problem = isParticipantId(typed) ? texts_.idTaken : texts_.idMalformed;
                if (verdict.broken) {
                    typed.clear();
                    problem.clear();
                    turnTo(page);
                    break; // these inputs are gone: the question has asked for others
                }
            }
            if (edit(typed, input))
                problem.clear();
        }
        if (before != std::pair(typed, problem)) {
            page = startSheet(start, typed, problem);
            showSheet(page);
        }
    }
}

bool Presenter::goesOn(int trials) {
    return choose(sheet(resumePage(texts_, trials, longest(study_.protocol)), "go on?")) == 1;
}

} // namespace obscura
