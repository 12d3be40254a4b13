#include "replay/ReplayFiles.hpp"

#include "common/trace/TraceFiles.hpp"
#include "replay/RecordKind.hpp"
#include "replay/RecordLine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>
#include <variant>

namespace ACS::Acsd
{

namespace
{

constexpr std::string_view TRACE_SUFFIX = ".ndjson";

} // namespace

Core::Result<ReplayFiles> ReplayFiles::Open(const std::string& path)
{
    ReplayFiles files;
    std::error_code error;
    if (std::filesystem::is_directory(path, error))
    {
        for (std::filesystem::directory_iterator entry(path, error), end; !error && entry != end;
             entry.increment(error))
        {
            // The traces of simulators may be in the same folder.
            const std::string name = entry->path().filename().string();
            if (name.starts_with(Apps::TraceFileStyle().prefix) && name.ends_with(TRACE_SUFFIX))
            {
                files._files.push_back(entry->path().string());
            }
        }
        std::ranges::sort(files._files); // their numbers have six digits
    }
    else
    {
        files._files.push_back(path);
    }
    if (error || files._files.empty())
    {
        return Core::Fail(
            error ? error : std::make_error_code(std::errc::no_such_file_or_directory),
            path,
            error ? std::string() : "a file of a trace, or a folder with files acsd-*.ndjson",
            {});
    }
    for (const std::string& file : files._files)
    {
        if (!std::ifstream(file).is_open())
        {
            return Core::Fail(std::make_error_code(std::errc::io_error), file, "a file that can be read", {});
        }
    }
    return files;
}

std::optional<CoreRecord> ReplayFiles::FindRunOrNull()
{
    std::optional<CoreRecord> record = std::exchange(_next, std::nullopt);
    do
    {
        if (record.has_value() && record->kind == BEGIN_KIND)
        {
            _fault.clear();
            return record;
        }
        record = ReadOrNull();
    }
    while (record.has_value() || !_fault.empty());
    return std::nullopt;
}

std::optional<CoreRecord> ReplayFiles::ReadNextOrNull()
{
    if (!_fault.empty() || _next.has_value())
    {
        return std::nullopt;
    }
    std::optional<CoreRecord> record = ReadOrNull();
    if (record.has_value() && record->kind == BEGIN_KIND)
    {
        _next = std::move(record);
        return std::nullopt;
    }
    return record;
}

const std::string& ReplayFiles::GetFault() const noexcept
{
    return _fault;
}

/// nullopt: at the end, or after setting the fault.
std::optional<CoreRecord> ReplayFiles::ReadOrNull()
{
    _fault.clear();
    std::string line;
    while (TryReadLine(line))
    {
        Core::Result<std::optional<std::variant<CoreRecord, LostLines>>> read = ReadRecord(line);
        const std::string place = fmt::format("{}:{}", std::filesystem::path(_name).filename().string(), _line);
        if (!read.has_value())
        {
            _fault = fmt::format("{}: {}", place, Core::Describe(read.error()));
            return std::nullopt;
        }
        if (!read->has_value())
        {
            continue;
        }
        if (const auto* const lostOrNull = std::get_if<LostLines>(&**read))
        {
            _fault = fmt::format("{}: {} lines of the trace were lost here", place, lostOrNull->count);
            return std::nullopt;
        }
        CoreRecord record = std::move(std::get<CoreRecord>(**read));
        record.place = place;
        return record;
    }
    return std::nullopt;
}

bool ReplayFiles::TryReadLine(std::string& line)
{
    while (!_file.is_open() || !std::getline(_file, line) || _file.eof()) // the last line may lack its end
    {
        if (_files.empty())
        {
            return false;
        }
        _file = std::ifstream(_files.front(), std::ios::binary);
        _name = std::move(_files.front());
        _files.pop_front();
        _line = 0;
    }
    ++_line;
    return true;
}

} // namespace ACS::Acsd
