#include "mis/cli/usage_check.h"

#include "mis/cli/options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>

namespace mis::cli {

namespace {

/// "--name" and "-n"; not "-", a negative number, or a word.
bool looks_like_option(const std::string& word)
{
    return word.size() > 1 && word[0] == '-' &&
           (word[1] == '-' || std::isalpha(static_cast<unsigned char>(word[1])) != 0);
}

/// "--name" of "--name=value", "-n" of "-n5".
std::string name_in(const std::string& word)
{
    return word.starts_with("--") ? word.substr(0, word.find('=')) : word.substr(0, 2);
}

const CLI::Option* option_named(const CLI::App& command, const std::string& name)
{
    for (const CLI::Option* option : command.get_options())
        if (name.starts_with("--") ? option->check_lname(name.substr(2))
                                   : option->check_sname(name.substr(1)))
            return option;
    return nullptr;
}

bool takes_value(const CLI::Option& option) { return option.get_items_expected_max() > 0; }

/// "--seed N (seed of the random numbers)".
std::string how_to_write(const CLI::Option& option)
{
    const std::string usage = option.get_positional()
                                  ? option.get_type_name()
                                  : option.get_name() + " " + option.get_type_name();
    return fmt::format("{} ({})", usage, option.get_description());
}

[[noreturn]] void refuse_option(const CLI::App& command, const std::string& name)
{
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options()) {
        for (const std::string& known : option->get_lnames()) names.push_back("--" + known);
        if (option->get_lnames().empty())
            for (const std::string& known : option->get_snames()) names.push_back("-" + known);
    }
    const std::vector<std::string_view> known(names.begin(), names.end());
    refuse_name(command.get_name() + ": found option", name, known,
                fmt::format("{}", fmt::join(names, ", ")));
}

/// Goes through the words of one command.
class Walk {
public:
    Walk(const CLI::App& command, std::span<const std::string> words)
        : command_(command), words_(words)
    {
    }

    void check()
    {
        for (; at_ < words_.size(); ++at_) {
            const std::string& word = words_[at_];
            if (!is_after_dashes_ && word == "--") is_after_dashes_ = true;
            else if (!is_after_dashes_ && looks_like_option(word)) check_option(word);
            else plain_.push_back(word);
        }
        check_plain_words();
        for (const CLI::Option* option : command_.get_options())
            if (option->get_required() && !option->get_positional() && !given_.contains(option))
                throw UsageError(fmt::format("{}: found no {}; it needs {}", command_.get_name(),
                                             option->get_name(), how_to_write(*option)));
    }

private:
    void check_option(const std::string& word)
    {
        const std::string name = name_in(word);
        const CLI::Option* option = option_named(command_, name);
        if (option == nullptr) refuse_option(command_, name);
        const bool has_value = word.size() > name.size();
        if (!takes_value(*option)) {
            if (has_value && name.starts_with("--"))
                throw UsageError(fmt::format("{}: found the value \"{}\"; it takes none", name,
                                             word.substr(name.size() + 1)));
            return;
        }
        const std::string value = has_value ? value_in(word, name) : next_word(*option);
        if (const auto [at, is_new] = given_.emplace(option, value); !is_new)
            throw UsageError(fmt::format("{}: found twice, with \"{}\" and \"{}\"; give it once",
                                         name, at->second, value));
    }

    static std::string value_in(const std::string& word, const std::string& name)
    {
        const std::string value = word.substr(name.size() + (name.starts_with("--") ? 1 : 0));
        if (value.empty()) throw UsageError(name + ": found no value after \"=\"");
        return value;
    }

    bool is_known_option(const std::string& word) const
    {
        return looks_like_option(word) && option_named(command_, name_in(word)) != nullptr;
    }

    const std::string& next_word(const CLI::Option& option)
    {
        const bool is_last = at_ + 1 == words_.size();
        if (is_last || is_known_option(words_[at_ + 1]))
            throw UsageError(fmt::format(
                "{}: found no value{}; it takes one: {}", option.get_name(),
                is_last ? "" : fmt::format(" before {}", words_[at_ + 1]), how_to_write(option)));
        return words_[++at_];
    }

    void check_plain_words() const
    {
        const CLI::Option* taken = nullptr;
        for (const CLI::Option* option : command_.get_options())
            if (option->get_positional()) taken = option;
        const std::string& name = command_.get_name();
        if (taken == nullptr && !plain_.empty())
            throw UsageError(
                fmt::format("{}: found \"{}\"; it takes options alone", name, plain_[0]));
        if (taken == nullptr) return;
        if (plain_.empty())
            throw UsageError(fmt::format("{}: found no {}; it needs {}", name,
                                         taken->get_type_name(), how_to_write(*taken)));
        if (plain_.size() > static_cast<std::size_t>(taken->get_items_expected_max()))
            throw UsageError(fmt::format("{}: found \"{}\" after \"{}\"; it takes one {}", name,
                                         plain_[1], plain_[0], taken->get_type_name()));
    }

    const CLI::App& command_;
    std::span<const std::string> words_;
    std::size_t at_ = 0;
    bool is_after_dashes_ = false;
    std::vector<std::string> plain_;
    std::map<const CLI::Option*, std::string> given_;
};

}  // namespace

bool asks_for_help(std::span<const std::string> words)
{
    const auto end = std::find(words.begin(), words.end(), "--");
    return std::any_of(words.begin(), end,
                       [](const std::string& word) { return word == "--help" || word == "-h"; });
}

CLI::App& command_named(CLI::App& app, const std::string& word)
{
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
        names.push_back(command->get_name());
    if (std::find(names.begin(), names.end(), word) != names.end())
        return *app.get_subcommand(word);
    names.insert(names.end(), {"help", "--help", "--version"});
    const std::vector<std::string_view> known(names.begin(), names.end());
    refuse_name(looks_like_option(word) ? "found option" : "found command", word, known);
}

void check_usage(const CLI::App& command, std::span<const std::string> words)
{
    Walk(command, words).check();
}

}  // namespace mis::cli
