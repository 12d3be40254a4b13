#include "trace/TraceSource.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstddef>
#include <map>
#include <optional>
#include <string_view>
#include <system_error>

namespace ACS::Acsctl
{

namespace
{

constexpr std::string_view SUFFIX = ".ndjson";
constexpr std::string_view DIGITS = "0123456789";

std::optional<TraceSource::Key> ReadKeyOrNull(std::string_view line)
{
    constexpr std::string_view BEGIN = R"({"time":")";
    constexpr std::string_view MIDDLE = R"(","mono_us":)";
    const std::size_t end = line.find('"', BEGIN.size());
    if (!line.starts_with(BEGIN) || end == std::string_view::npos || !line.substr(end).starts_with(MIDDLE))
    {
        return std::nullopt;
    }
    const std::string_view digits = line.substr(end + MIDDLE.size());
    std::uint64_t micros = 0;
    const bool bNumber = std::from_chars(digits.data(), digits.data() + digits.size(), micros).ec == std::errc();
    return bNumber ? std::optional(TraceSource::Key(line.substr(BEGIN.size(), end - BEGIN.size()), micros))
                   : std::nullopt;
}

/// "acsd-000012.ndjson": "acsd-" and 12. A name without such a number is a program of its own.
std::pair<std::string, std::uint64_t> SplitFileName(const std::string& name)
{
    const std::string_view stem = std::string_view(name).substr(0, name.size() - SUFFIX.size());
    const std::size_t last = stem.find_last_not_of(DIGITS);
    const std::string_view digits = last == std::string_view::npos ? stem : stem.substr(last + 1);
    std::uint64_t number = 0;
    constexpr std::size_t FEWEST_DIGITS = 6;
    const bool bNumber = digits.size() >= FEWEST_DIGITS
        && std::from_chars(digits.data(), digits.data() + digits.size(), number).ec == std::errc();
    return bNumber ? std::pair(std::string(stem.substr(0, stem.size() - digits.size())), number)
                   : std::pair(name, std::uint64_t{0});
}

Outcome<void> AddFolder(const std::filesystem::path& folder, std::vector<TraceSource>& sources)
{
    std::map<std::string, std::map<std::uint64_t, std::filesystem::path>> programs;
    std::error_code error;
    for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    {
        const std::string name = entry->path().filename().string();
        if (name.size() > SUFFIX.size() && name.ends_with(SUFFIX))
        {
            const auto [program, number] = SplitFileName(name);
            programs[program][number] = entry->path();
        }
    }
    if (error)
    {
        return FailWith(
            EXIT_BAD_INPUT,
            fmt::format("--file: cannot read the folder {}: {}", folder.string(), error.message()));
    }
    if (programs.empty())
    {
        return FailWith(
            EXIT_BAD_INPUT,
            fmt::format(
                "--file: the folder {} has no trace (*.ndjson); give the folder of --trace of acsd or of a simulator",
                folder.string()));
    }
    for (const auto& [program, numbered] : programs)
    {
        std::vector<std::filesystem::path> files;
        for (const auto& [number, path] : numbered)
        {
            files.push_back(path);
        }
        sources.emplace_back(std::move(files));
    }
    return {};
}

} // namespace

TraceSource::TraceSource(std::vector<std::filesystem::path> files)
    : _files(std::move(files))
{
    std::ranges::reverse(_files);
}

Outcome<bool> TraceSource::ReadNext()
{
    // A line without its end is the last one of a program that was killed.
    while (!_file.is_open() || !std::getline(_file, _line) || _file.eof())
    {
        Outcome<bool> opened = OpenNext();
        if (!opened.has_value() || !*opened)
        {
            return opened;
        }
    }
    ++_lineNumber;
    std::optional<Key> key = ReadKeyOrNull(_line);
    if (!key.has_value())
    {
        return FailWith(
            EXIT_BAD_INPUT,
            fmt::format(
                "--file: {}:{} is not a line of a trace (docs/reference/trace.md)",
                _path.string(),
                _lineNumber));
    }
    _key = std::move(*key);
    return true;
}

Outcome<bool> TraceSource::OpenNext()
{
    while (!_files.empty())
    {
        _path = std::move(_files.back());
        _files.pop_back();
        _lineNumber = 0;
        _file = std::ifstream(_path, std::ios::binary);
        if (_file.is_open())
        {
            return true;
        }
        const std::error_code error(errno, std::generic_category());
        if (error != std::errc::no_such_file_or_directory)
        {
            return FailWith(EXIT_BAD_INPUT, fmt::format("--file: cannot read {}: {}", _path.string(), error.message()));
        }
    }
    return false;
}

const std::string& TraceSource::GetLine() const noexcept
{
    return _line;
}

const TraceSource::Key& TraceSource::GetKey() const noexcept
{
    return _key;
}

Outcome<std::vector<TraceSource>> FindTraceSources(const std::vector<std::string>& paths)
{
    std::vector<TraceSource> sources;
    for (const std::string& path : paths)
    {
        std::error_code error;
        const std::filesystem::file_status status = std::filesystem::status(path, error);
        if (std::filesystem::is_directory(status))
        {
            if (Outcome<void> added = AddFolder(path, sources); !added.has_value())
            {
                return tl::make_unexpected(std::move(added.error()));
            }
            continue;
        }
        if (!std::filesystem::exists(status))
        {
            return FailWith(EXIT_BAD_INPUT, fmt::format("--file: cannot read {}: {}", path, error.message()));
        }
        sources.emplace_back(std::vector<std::filesystem::path>{path});
    }
    return sources;
}

} // namespace ACS::Acsctl
