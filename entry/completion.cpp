#include "entry/completion.h"

#include <algorithm>
#include <cctype>
#include <sstream>

namespace obscura {

namespace {

using Kind = Argument::Kind;

bool isOption(const std::string& word) { // a negative number is none
    return word.starts_with('-') &&
           (word.size() == 1 ||
            !(std::isdigit(static_cast<unsigned char>(word[1])) || word[1] == '.'));
}

// Drops the signs between options and values, so that a value follows its option. A sign on which
// the cursor stands is followed by a value of which nothing is typed.
std::vector<std::string> withoutSigns(std::vector<std::string> words) {
    if (words.back() == "=")
        words.push_back("");
    std::erase(words, "=");
    return words;
}

// Where on the command line the last word is.
class Position {
  public:
    Position(const std::vector<Argument>& program, const std::vector<std::string>& words)
        : program_(program) {
        for (std::size_t i = 0; i + 1 < words.size(); ++i)
            pass(words[i]);
    }

    // Whose value the last word is: an option's, while it takes more of them, or a positional's.
    const Argument* takes() const { return left_ > 0 ? option_ : positional(); }
    bool mayBeCommand() const { return left_ == 0 && passed_ == 0; }

    std::vector<const Argument*> all(Kind kind) const { // of the command
        std::vector<const Argument*> found;
        for (const Argument& each : program_)
            if (each.kind == kind && each.command == command_)
                found.push_back(&each);
        return found;
    }
    const Argument* named(Kind kind, const std::string& name) const {
        for (const Argument* each : all(kind))
            if (each->name == name)
                return each;
        return nullptr;
    }

  private:
    void pass(const std::string& word) {
        if (isOption(word)) {
            option_ = named(Kind::option, word);
            left_ = option_ ? option_->values : 0;
        } else if (left_ > 0) {
            --left_;
        } else if (command_.empty() && passed_ == 0 && named(Kind::command, word)) {
            command_ = word;
        } else {
            ++passed_;
        }
    }

    // The one whose turn it is, or the last if it takes any number.
    const Argument* positional() const {
        std::size_t before = 0;
        for (const Argument* each : all(Kind::positional)) {
            before += static_cast<std::size_t>(each->values);
            if (passed_ < before)
                return each;
        }
        return nullptr;
    }

    const std::vector<Argument>& program_;
    std::string command_;
    const Argument* option_ = nullptr; // the last one
    int left_ = 0;                     // of its values
    std::size_t passed_ = 0;           // positionals
};

void addValues(const Argument& argument, const std::vector<std::string>& protocols,
               Completion& completion) {
    const std::string& takes = argument.takes;
    completion.also = takes == "FILE" || takes == "PROTOCOL" ? "files"
                      : takes == "DIR"                       ? "folders"
                                                             : "nothing";
    if (takes == "PROTOCOL")
        for (const std::string& name : protocols)
            completion.words.push_back({name, "comes with Obscura"});
    else if (completion.also == "nothing") {
        std::istringstream words(takes);
        for (std::string word; words >> word;)
            completion.words.push_back({word, ""});
    }
}

} // namespace

Completion completionOf(const std::vector<Argument>& program, std::vector<std::string> words,
                        const std::vector<std::string>& protocols) {
    words = withoutSigns(std::move(words));
    const Position position(program, words);
    const std::string& typed = words.back();
    Completion completion{{}, "nothing"};
    const std::size_t sign = isOption(typed) ? typed.find('=') : typed.npos;
    if (sign != typed.npos) {
        if (const Argument* option = position.named(Kind::option, typed.substr(0, sign)))
            addValues(*option, protocols, completion);
        for (Completion::Word& word : completion.words)
            word.text = typed.substr(0, sign + 1) + word.text;
    } else if (isOption(typed)) {
        for (const Argument* option : position.all(Kind::option))
            completion.words.push_back({option->name, option->about});
    } else {
        if (const Argument* argument = position.takes())
            addValues(*argument, protocols, completion);
        if (position.mayBeCommand())
            for (const Argument* command : position.all(Kind::command))
                completion.words.push_back({command->name, command->about});
    }
    std::erase_if(completion.words,
                  [&](const Completion::Word& word) { return !word.text.starts_with(typed); });
    return completion;
}

} // namespace obscura
