// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Counts dots between bare and quoted words, outside of texts and comments.
#include "case/toml_depth.hpp"

#include <algorithm>
#include <string>

namespace periporo {
namespace {

/// Walks through a text, over its comments and quoted parts.
class Walk {
public:
    explicit Walk(std::string_view text) : text_(text) {}

    std::optional<DeepKey> find()
    {
        std::size_t dots = 0; // of the key that the walk is in
        while (at_ < text_.size()) {
            const char c = text_[at_];
            if (c == '"' || c == '\'') {
                skip_quoted(c);
                continue;
            }
            if (c == '#')
                at_ = std::min(text_.find('\n', at_), text_.size() - 1);
            else if (c == '.' && ++dots >= most_key_parts)
                return place();
            if (is_end_of_key(text_[at_]))
                dots = 0;
            ++at_;
        }
        return std::nullopt;
    }

private:
    static bool is_end_of_key(char c) { return std::string_view("=,[]{}\n").find(c) != std::string_view::npos; }

    void skip_quoted(char quote)
    {
        const std::size_t run = std::min(text_.find_first_not_of(quote, at_), text_.size()) - at_;
        const bool multi_line = run >= 3;
        at_ += multi_line ? 3 : 1;
        while (at_ < text_.size()) {
            const char c = text_[at_];
            if (c == '\\' && quote == '"') {
                at_ += 2;
                continue;
            }
            if (c == '\n' && !multi_line)
                return; // an error, which the parser reports
            const bool ends = c == quote && (!multi_line || (text_.substr(at_).starts_with(std::string(3, quote))));
            at_ += ends && multi_line ? 3 : 1;
            if (ends)
                return;
        }
    }

    DeepKey place() const
    {
        const std::string_view before = text_.substr(0, at_);
        const std::size_t line_begin = before.rfind('\n') + 1; // npos + 1 is 0
        return {static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n')) + 1, at_ - line_begin + 1};
    }

    std::string_view text_;
    std::size_t at_ = 0;
};

} // namespace

std::optional<DeepKey> find_deep_key(std::string_view text)
{
    return Walk(text).find();
}

} // namespace periporo
