#include "experiment/page_run.h"

#include "experiment/broken_session.h"
#include "experiment/play.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace obscura {

namespace {

// How many pages there are up to the last that can end the session.
std::size_t gated(const std::vector<Phase>& pages) {
    const auto last = std::find_if(pages.rbegin(), pages.rend(), [](const Phase& page) {
        return std::any_of(page.questions.begin(), page.questions.end(),
                           [](const Question& each) { return !each.endsUnless.empty(); });
    });
    return static_cast<std::size_t>(pages.rend() - last);
}

// The first question whose answer ends the session; the number of them when none does.
std::size_t endingIn(const Phase& page, const std::vector<FormAnswer>& answers) {
    std::size_t index = 0;
    while (index < page.questions.size() && admits(page.questions[index], answers[index].value))
        ++index;
    return index;
}

} // namespace

PagesEnd runPages(const Context& context, std::string_view kind, const std::set<std::string>& done,
                  Observer& observer, Recorder& recorder) {
    const Protocol& protocol = context.study.protocol;
    const std::vector<Phase>& pages = kind == "before" ? protocol.before : protocol.after;
    const std::size_t gate = gated(pages);
    std::vector<std::pair<std::string, TrialLines>> held;
    for (std::size_t i = 0; i < pages.size(); ++i) {
        const Phase& page = pages[i];
        if (done.contains(pageKey(kind, page.name)))
            continue;
        TrialMachine machine({page}, 0, context.refresh.hz, protocol.keys);
        observer.preparePage(page);
        if (!play(machine, observer, [] {}))
            return {};
        const TrialRecord& record = machine.record();
        if (const std::size_t ending = endingIn(page, record.answers);
            ending < page.questions.size()) {
            recorder.pageFinished(kind, page.name,
                                  {"", "", answerLineOf(context, kind, page, record, ending)});
            observer.decline();
            return {false, page.questions[ending].name};
        }
        held.emplace_back(page.name, linesOf(context, kind, page, record));
        for (; i + 1 >= gate && !held.empty(); held.erase(held.begin()))
            recorder.pageFinished(kind, held.front().first, held.front().second);
    }
    return {true, ""};
}

} // namespace obscura
