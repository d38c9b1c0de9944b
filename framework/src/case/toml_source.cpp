// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Reads TOML files with their includes.
#include "case/toml_source.hpp"

#include "case/toml_depth.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <system_error>
#include <tuple>
#include <utility>

namespace periporo {
namespace {

using SourcePointer = std::shared_ptr<const CaseSource>;

constexpr std::uintmax_t most_bytes = 16 << 20; ///< of a case file; data belong into files of their own
constexpr std::size_t longest_chain = 32;       ///< of files that include one another

std::vector<std::string> split_lines(const std::string& text)
{
    std::vector<std::string> lines;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        lines.push_back(text.substr(begin, end - begin));
        if (!lines.back().empty() && lines.back().back() == '\r')
            lines.back().pop_back();
        begin = end + 1;
    }
    return lines;
}

Place place_of(const toml::source_region& region, const SourcePointer& source)
{
    if (!source->override_text.empty())
        return {source, 0, 0};
    return {source, region.begin.line, region.begin.column};
}

CaseNode convert(const toml::node& node, const SourcePointer& source)
{
    CaseNode result{CaseNode::Other{}, place_of(node.source(), source)};
    if (const toml::table* table = node.as_table()) {
        CaseNode::Table entries;
        for (const auto& [key, value] : *table)
            entries.push_back({std::string(key.str()), place_of(key.source(), source), convert(value, source)});
        // The library sorts by name; a case keeps the order it was written in.
        std::stable_sort(entries.begin(), entries.end(), [](const CaseEntry& a, const CaseEntry& b) {
            return std::tie(a.place.line, a.place.column) < std::tie(b.place.line, b.place.column);
        });
        result.value = std::move(entries);
    } else if (const toml::array* array = node.as_array()) {
        CaseNode::Array members;
        for (const toml::node& member : *array)
            members.push_back(convert(member, source));
        result.value = std::move(members);
    } else if (const auto* text = node.as_string()) {
        result.value = text->get();
    } else if (const auto* real = node.as_floating_point()) {
        result.value = real->get();
    } else if (const auto* whole = node.as_integer()) {
        result.value = whole->get();
    } else if (const auto* boolean = node.as_boolean()) {
        result.value = boolean->get();
    }
    return result;
}

/// Lays `over` on top of `base`: tables entry by entry, everything else replaced.
void merge(CaseNode& base, CaseNode&& over)
{
    if (base.table() == nullptr || over.table() == nullptr) {
        base = std::move(over);
        return;
    }
    base.place = over.place;
    for (CaseEntry& entry : *over.table()) {
        if (CaseEntry* existing = base.find(entry.key)) {
            existing->place = entry.place;
            merge(existing->node, std::move(entry.node));
        } else {
            base.table()->push_back(std::move(entry));
        }
    }
}

/// What a regular file of a sensible size is not, or an empty text.
std::string objection_to_file(const std::filesystem::path& file)
{
    std::error_code error;
    if (!std::filesystem::exists(file, error))
        return "no such file";
    if (std::filesystem::is_directory(file, error))
        return "it is a folder";
    if (!std::filesystem::is_regular_file(file, error)) // reading it might never end
        return "it is no regular file";
    if (std::filesystem::file_size(file, error) > most_bytes)
        return fmt::format("it has more than {} MB; tables and points belong into files that the case names",
                           most_bytes >> 20);
    return error ? error.message() : std::string();
}

/// What a text is not that a case file has to be, or an empty text.
std::string objection_to_text(std::string_view text)
{
    if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff"))
        return "it is written in UTF-16; save it as UTF-8";
    if (text.find('\0') != std::string_view::npos)
        return "it holds NUL bytes and is no text, or a text in UTF-16 or UTF-32; save it as UTF-8";
    return {};
}

/// Follows includes depth first and remembers the chain it came along. A file that is included several times is read
/// once.
class FileReader {
public:
    explicit FileReader(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

    std::optional<CaseNode> read(const std::filesystem::path& file, const Place* included_from)
    {
        const auto source = std::make_shared<CaseSource>();
        source->file = file;
        source->order = files_.size();
        files_.push_back(file);
        const std::optional<std::string> text = load(file, source, included_from);
        if (!text)
            return std::nullopt;
        source->lines = split_lines(*text);
        if (const std::optional<DeepKey> deep = find_deep_key(*text)) {
            diagnostics_.error({source, deep->line, deep->column},
                               fmt::format("a key has more than {} parts", most_key_parts),
                               "no key of a case has more than ten; look for a missing quote or bracket");
            return std::nullopt;
        }
        std::optional<CaseNode> own;
        try {
            const toml::table table = toml::parse(std::string_view(*text));
            own = convert(table, source);
        } catch (const toml::parse_error& error) {
            const bool encoding = error.description().find("utf-8") != std::string_view::npos;
            diagnostics_.error(place_of(error.source(), source), std::string(error.description()),
                               encoding ? "save the file as UTF-8" : "");
            return std::nullopt;
        }
        own->place = {source, 0, 0};
        return with_includes(std::move(*own), file);
    }

    const std::vector<std::filesystem::path>& files_read() const { return files_; }

private:
    std::optional<std::string> load(const std::filesystem::path& file, const SourcePointer& source,
                                    const Place* included_from)
    {
        std::string reason = objection_to_file(file);
        if (reason.empty()) {
            std::ifstream stream(file, std::ios::binary);
            std::string text(std::istreambuf_iterator<char>(stream), {});
            reason = stream.is_open() ? objection_to_text(text) : "it cannot be opened";
            if (reason.empty())
                return text;
        }
        if (included_from != nullptr)
            diagnostics_.error(*included_from,
                               fmt::format("'include' names \"{}\", which cannot be read: {}", file.string(), reason),
                               "paths are relative to the file that includes");
        else
            diagnostics_.error({source, 0, 0}, "cannot read the case: " + reason);
        return std::nullopt;
    }

    CaseNode with_includes(CaseNode&& own, const std::filesystem::path& file)
    {
        CaseEntry* include = own.find("include");
        if (include == nullptr)
            return std::move(own);
        const CaseNode list = std::move(include->node);
        own.table()->erase(own.table()->begin() + (include - own.table()->data()));

        chain_.push_back(std::filesystem::weakly_canonical(file));
        CaseNode base{CaseNode::Table{}, own.place};
        const CaseNode::Array* members = list.array();
        if (members == nullptr)
            diagnostics_.error(list.place, fmt::format("'include' must be a list of texts, not {}", found_text(list)),
                               "include = [\"base.toml\"]");
        else
            for (const CaseNode& member : *members)
                if (std::optional<CaseNode> included = read_included(member, file))
                    merge(base, std::move(*included));
        chain_.pop_back();
        merge(base, std::move(own));
        return base;
    }

    std::optional<CaseNode> read_included(const CaseNode& member, const std::filesystem::path& file)
    {
        if (member.text() == nullptr) {
            diagnostics_.error(member.place,
                               fmt::format("'include' must be a list of texts, not of {}", found_text(member)));
            return std::nullopt;
        }
        if (member.text()->empty()) {
            diagnostics_.error(member.place, "'include' names no file: the text is empty", "include = [\"base.toml\"]");
            return std::nullopt;
        }
        const std::filesystem::path path = (file.parent_path() / *member.text()).lexically_normal();
        std::error_code fault;
        const std::filesystem::path canonical = std::filesystem::weakly_canonical(path, fault);
        if (fault) {
            diagnostics_.error(member.place, fmt::format("'include' names \"{}\", which cannot be read: {}",
                                                         path.string(), fault.message()));
            return std::nullopt;
        }
        if (std::find(chain_.begin(), chain_.end(), canonical) != chain_.end()) {
            diagnostics_.error(member.place, fmt::format("{} includes itself", path.string()),
                               include_chain(canonical));
            return std::nullopt;
        }
        if (chain_.size() >= longest_chain) {
            diagnostics_.error(member.place, fmt::format("more than {} files include one another", longest_chain),
                               "include the last ones of the chain directly");
            return std::nullopt;
        }
        const auto known = read_before_.find(canonical);
        if (known == read_before_.end())
            return read_before_.emplace(canonical, read(path, &member.place)).first->second;
        return known->second;
    }

    std::string include_chain(const std::filesystem::path& last) const
    {
        std::string text;
        for (const std::filesystem::path& file : chain_)
            text += file.string() + " includes\n";
        return text + last.string();
    }

    Diagnostics& diagnostics_;
    std::vector<std::filesystem::path> chain_;
    std::map<std::filesystem::path, std::optional<CaseNode>> read_before_; ///< with its own includes
    std::vector<std::filesystem::path> files_;
};

} // namespace

CaseNode read_toml_files(const std::filesystem::path& file, Diagnostics& diagnostics,
                         std::vector<std::filesystem::path>* files_read)
{
    FileReader reader(diagnostics);
    std::optional<CaseNode> root = reader.read(file, nullptr);
    diagnostics.raise();
    if (files_read != nullptr)
        *files_read = reader.files_read();
    return std::move(*root);
}

std::optional<CaseNode> parse_toml_value(const std::string& text, const SourcePointer& source)
{
    if (text.find('\n') != std::string::npos || find_deep_key(text))
        return std::nullopt; // a line break could smuggle in further keys
    try {
        const toml::table table = toml::parse(std::string_view("value = " + text));
        return convert(*table.get("value"), source);
    } catch (const toml::parse_error&) {
        return std::nullopt;
    }
}

} // namespace periporo
