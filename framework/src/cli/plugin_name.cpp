// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The rules of names and the replacement of my_plugin.
#include "cli/plugin_name.hpp"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <utility>

namespace periporo::cli {
namespace {

/// C++20, [lex.key] and the alternative tokens of [lex.digraph].
constexpr std::string_view keywords[] = {
    "alignas",     "alignof",  "and",        "and_eq",    "asm",       "auto",         "bitand",
    "bitor",       "bool",     "break",      "case",      "catch",     "char",         "char8_t",
    "char16_t",    "char32_t", "class",      "co_await",  "co_return", "co_yield",     "compl",
    "concept",     "const",    "const_cast", "consteval", "constexpr", "constinit",    "continue",
    "decltype",    "default",  "delete",     "do",        "double",    "dynamic_cast", "else",
    "enum",        "explicit", "export",     "extern",    "false",     "float",        "for",
    "friend",      "goto",     "if",         "inline",    "int",       "long",         "mutable",
    "namespace",   "new",      "noexcept",   "not",       "not_eq",    "nullptr",      "operator",
    "or",          "or_eq",    "private",    "protected", "public",    "register",     "reinterpret_cast",
    "requires",    "return",   "short",      "signed",    "sizeof",    "static",       "static_assert",
    "static_cast", "struct",   "switch",     "template",  "this",      "thread_local", "throw",
    "true",        "try",      "typedef",    "typeid",    "typename",  "union",        "unsigned",
    "using",       "virtual",  "void",       "volatile",  "wchar_t",   "while",        "xor",
    "xor_eq"};

bool is_lower_letter(char c)
{
    return c >= 'a' && c <= 'z';
}

/// Words of lower-case letters and digits with one underscore between them, beginning with a letter.
bool is_lower_snake_case(std::string_view name)
{
    if (name.empty() || !is_lower_letter(name.front()) || name.back() == '_')
        return false;
    const auto allowed = [](char c) { return is_lower_letter(c) || (c >= '0' && c <= '9') || c == '_'; };
    return std::all_of(name.begin(), name.end(), allowed) && name.find("__") == std::string_view::npos;
}

std::string replaced(std::string text, std::string_view from, std::string_view to)
{
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
    return text;
}

} // namespace

std::string name_objection(std::string_view name)
{
    if (!is_lower_snake_case(name))
        return "a name is lower-case letters, digits and single underscores and begins with a letter, as my_clay does";
    if (std::find(std::begin(keywords), std::end(keywords), name) != std::end(keywords))
        return "it is a keyword of C++";
    return "";
}

std::string class_name(std::string_view name)
{
    std::string result;
    bool starts_word = true;
    for (const char c : name) {
        if (c != '_')
            result += starts_word ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
        starts_word = c == '_';
    }
    return result;
}

std::string renamed(std::string_view text, std::string_view name)
{
    std::string words(name);
    std::replace(words.begin(), words.end(), '_', ' ');
    // None of the three forms occurs in another, so the order does not matter.
    std::string result = replaced(std::string(text), "MyPlugin", class_name(name));
    result = replaced(std::move(result), "my_plugin", name);
    return replaced(std::move(result), "my plugin", words);
}

} // namespace periporo::cli
