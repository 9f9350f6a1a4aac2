#include "mis/io/json_document.h"

#include "mis/io/json_faults.h"
#include "mis/io/scene_error.h"
#include "mis/io/text_file.h"
#include "mis/scene/text.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cctype>
#include <cstdint>
#include <iterator>
#include <vector>

namespace mis {
namespace {

/// A text for the parser, which asks the token now and then: a gigabyte of blanks makes no event.
class StoppableText {
public:
    using iterator_category = std::input_iterator_tag;
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = const char*;
    using reference = const char&;

    StoppableText(const char* at, const StopToken& stop) : at_(at), stop_(&stop) {}
    reference operator*() const { return *at_; }
    StoppableText& operator++()
    {
        constexpr std::uintptr_t often = 1 << 16;
        if (reinterpret_cast<std::uintptr_t>(++at_) % often == 0) stop_->check();
        return *this;
    }
    StoppableText operator++(int)
    {
        const StoppableText before = *this;
        ++*this;
        return before;
    }
    bool operator==(const StoppableText& other) const { return at_ == other.at_; }
    bool operator!=(const StoppableText& other) const { return at_ != other.at_; }

private:
    const char* at_;
    const StopToken* stop_;
};

/// Builds the document event by event, so that what nlohmann's own parser lets pass is seen: a key
/// given twice, a number that rounds to 0, nesting without end.
class DocumentBuilder final : public nlohmann::json_sax<Json> {
public:
    DocumentBuilder(std::string_view text, const std::filesystem::path& file,
                    std::string_view streamed_list, const ElementSink& sink)
        : text_(text), file_(file), streamed_list_(streamed_list), sink_(sink)
    {
    }

    Json take_document() { return std::move(document_); }

    bool null() override { return add(nullptr); }
    bool boolean(bool value) override { return add(value); }
    bool number_integer(number_integer_t value) override { return add(value); }
    bool number_unsigned(number_unsigned_t value) override { return add(value); }
    bool string(string_t& value) override { return add(std::move(value)); }
    bool binary(binary_t& value) override { return add(std::move(value)); }

    bool number_float(number_float_t value, const string_t& written) override
    {
        const std::string_view digits =
            std::string_view(written).substr(0, written.find_first_of("eE"));
        if (value == 0 && digits.find_first_of("123456789") != digits.npos) fail_range(written);
        return add(value);
    }

    bool start_object(std::size_t) override { return open(Json::object()); }
    bool end_object() override { return close(); }
    bool start_array(std::size_t) override { return open(Json::array()); }
    bool end_array() override { return close(); }

    bool key(string_t& name) override
    {
        Level& level = levels_.back();
        const auto [member, is_new] = level.container->emplace(name, nullptr);
        level.key = name;
        level.member = &*member;
        if (!is_new)
            throw SceneError(file_.string(),
                             Problem{pointer(), "the key " + in_quotes(name) + " a second time",
                                     "a key is given once", "Remove one of the two."});
        return true;
    }

    bool parse_error(std::size_t position, const std::string& token,
                     const nlohmann::detail::exception& error) override
    {
        constexpr int number_out_of_range = 406;
        if (error.id == number_out_of_range) {
            start_value();
            fail_range(token);
        }
        fail_syntax(position == 0 ? 0 : position - 1, token, error.what());
    }

private:
    struct Level {
        Json* container;
        std::string key{};       ///< of the member being read, in an object
        Json* member = nullptr;  ///< its value
        std::size_t count = 0;   ///< of the values begun, in an array
    };

    bool is_streamed() const
    {
        return sink_ && levels_.size() == 2 && levels_[0].key == streamed_list_ &&
               levels_[1].container->is_array();
    }

    void start_value()
    {
        if (!levels_.empty()) ++levels_.back().count;
    }

    Json* place(Json&& value)
    {
        start_value();
        if (levels_.empty()) return &(document_ = std::move(value));
        Level& level = levels_.back();
        if (level.container->is_object()) return &(*level.member = std::move(value));
        level.container->push_back(std::move(value));
        return &level.container->back();
    }

    void finish_value()
    {
        if (!is_streamed()) return;
        Level& list = levels_[1];
        sink_(document_, list.count - 1, list.container->back());
        list.container->clear();
    }

    bool add(Json value)
    {
        place(std::move(value));
        finish_value();
        return true;
    }

    bool open(Json container)
    {
        Json* const placed = place(std::move(container));
        if (levels_.size() >= limits::nesting)
            throw SceneError(
                file_.string(),
                Problem{pointer(),
                        fmt::format("more than {} levels of brackets and braces", limits::nesting),
                        fmt::format("a file nests at most {} levels", limits::nesting),
                        "Look for a stray bracket."});
        levels_.push_back({placed});
        return true;
    }

    bool close()
    {
        levels_.pop_back();
        finish_value();
        return true;
    }

    std::string pointer() const
    {
        std::string path;
        for (const Level& level : levels_)
            path += "/" + (level.container->is_array() ? to_text(level.count - 1)
                                                       : pointer_token(level.key));
        return path;
    }

    [[noreturn]] void fail_range(const std::string& written) const
    {
        throw SceneError(file_.string(),
                         Problem{pointer(), written,
                                 "a number lies within the range of a double, 5e-324 to 1.8e308",
                                 "Use other units."});
    }

    /// message: the parser's own words, "… syntax error while parsing value - invalid literal; last
    /// read: '…'; …".
    [[noreturn]] void fail_syntax(std::size_t byte, const std::string& token,
                                  std::string_view message) const
    {
        const std::string_view lead = "syntax error ", echo = "; last read: '";
        const std::size_t start = message.find(lead), echo_start = message.find(echo);
        std::string reason(message.substr(start == message.npos ? 0 : start + lead.size()));
        if (echo_start != message.npos)
            reason = message.substr(start + lead.size(), echo_start - start - lead.size());
        if (const auto fault = known_json_fault(text_, byte, reason))
            fail_at(fault->byte, fault->found, fault->allowed, fault->remedy);
        const bool token_is_exact =
            reason.find("string") != reason.npos || reason.find("number") != reason.npos;
        fail_at(byte,
                byte >= text_.size()
                    ? "the end of the text"
                    : in_quotes(token_is_exact && !is_mark(byte) ? token : word_at(byte)),
                fmt::format("this is not JSON ({})", reason), syntax_remedy(byte));
    }

    [[noreturn]] void fail_at(std::size_t byte, const std::string& found,
                              const std::string& allowed, const std::string& remedy) const
    {
        const auto [line, column] = place_in(text_, byte);
        throw SceneError(file_.string(), Problem{fmt::format("line {}, column {}", line, column),
                                                 found, allowed, remedy});
    }

    bool is_mark(std::size_t byte) const
    {
        return std::string_view("{}[],:").find(text_[byte]) != std::string_view::npos;
    }

    /// The word around a byte, or the byte if it belongs to none.
    std::string word_at(std::size_t byte) const
    {
        const bool is_in_word = std::isalnum(static_cast<unsigned char>(text_[byte])) != 0;
        return std::string(is_in_word ? word_around(text_, byte) : text_.substr(byte, 1));
    }

    std::string syntax_remedy(std::size_t byte) const
    {
        const std::size_t last = text_.substr(0, byte).find_last_not_of(" \t\r\n");
        const bool closing = byte < text_.size() && (text_[byte] == '}' || text_[byte] == ']');
        if (closing && last != text_.npos && text_[last] == ',')
            return "Remove the comma before it.";
        const std::string_view before = text_.substr(0, byte);
        if (before.substr(before.find_last_of("\r\n") + 1).find("\\\"") != before.npos)
            return "In \\\" the quote is part of the text. Write paths with /, or each \\ as \\\\.";
        return "Look for a missing comma, quote or bracket there, or just before.";
    }

    std::string_view text_;
    const std::filesystem::path& file_;
    std::string_view streamed_list_;
    const ElementSink& sink_;
    Json document_;
    std::vector<Level> levels_;
};

}  // namespace

Json parse_json(std::string_view text, const std::filesystem::path& file,
                std::string_view streamed_list, const ElementSink& sink, const StopToken& stop)
{
    require_utf8(text, file, stop);
    DocumentBuilder builder(text, file, streamed_list, sink);
    constexpr bool strict = true, ignore_comments = true;
    Json::sax_parse(StoppableText(text.data(), stop),
                    StoppableText(text.data() + text.size(), stop), &builder,
                    Json::input_format_t::json, strict, ignore_comments);
    return builder.take_document();
}

}  // namespace mis
