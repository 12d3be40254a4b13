#include "replay/ReplayFiles.hpp"

#include "common/trace/TraceFiles.hpp"
#include "replay/RecordKind.hpp"
#include "replay/RecordLine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <system_error>
#include <utility>
#include <variant>

namespace ACS::Acsd
{

namespace
{

constexpr std::string_view TRACE_SUFFIX = ".ndjson";
constexpr std::size_t PIECE_BYTES = 64U * 1024U;

} // namespace

Core::Result<ReplayFiles> ReplayFiles::Open(const std::string& path, std::size_t longestLine)
{
    ReplayFiles files;
    files._longestLine = longestLine;
    std::error_code error;
    if (std::filesystem::is_directory(path, error))
    {
        for (std::filesystem::directory_iterator entry(path, error), end; !error && entry != end;
             entry.increment(error))
        {
            // The traces of simulators may be in the same folder.
            const std::string name = entry->path().filename().string();
            std::error_code ignored;
            if (name.starts_with(Apps::TraceFileStyle().prefix) && name.ends_with(TRACE_SUFFIX)
                && entry->symlink_status(ignored).type() == std::filesystem::file_type::regular)
            {
                files._files.push_back(entry->path().string());
            }
        }
        // Their numbers have six digits, or more without leading zeros.
        std::ranges::sort(files._files, {}, [](const std::string& file) { return std::pair(file.size(), file); });
    }
    else if (std::filesystem::is_regular_file(path, error))
    {
        files._files.push_back(path);
    }
    else if (std::filesystem::exists(path, error))
    {
        return Core::Fail(
            std::make_error_code(std::errc::invalid_argument),
            path,
            "a regular file or a folder",
            "another type");
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

std::string ReplayFiles::DescribeForeign() const
{
    if (_bTrace)
    {
        return {};
    }
    return _firstFault.empty() ? std::string("not a trace of acsd: it has no complete line")
                               : "not a trace of acsd: " + _firstFault;
}

void ReplayFiles::SetFault(std::string fault)
{
    _fault = fmt::format("{}:{}: {}", std::filesystem::path(_name).filename().string(), _line, fault);
    if (_firstFault.empty())
    {
        _firstFault = _fault;
    }
}

/// nullopt: at the end, or after setting the fault.
std::optional<CoreRecord> ReplayFiles::ReadOrNull()
{
    _fault.clear();
    std::string line;
    while (TryReadLine(line))
    {
        Core::Result<std::optional<std::variant<CoreRecord, LostLines>>> read = ReadRecord(line);
        if (!read.has_value())
        {
            SetFault(Core::Describe(read.error()));
            return std::nullopt;
        }
        _bTrace = true;
        if (!read->has_value())
        {
            continue;
        }
        if (const auto* const lostOrNull = std::get_if<LostLines>(&**read))
        {
            SetFault(fmt::format("{} lines of the trace were lost here", lostOrNull->count));
            return std::nullopt;
        }
        CoreRecord record = std::move(std::get<CoreRecord>(**read));
        record.place = fmt::format("{}:{}", std::filesystem::path(_name).filename().string(), _line);
        return record;
    }
    return std::nullopt;
}

/// False: at the end, or after setting the fault.
bool ReplayFiles::TryReadLine(std::string& line)
{
    while (!_file.is_open() || !TryReadRest(line))
    {
        if (!_fault.empty() || _files.empty())
        {
            return false;
        }
        _file = std::ifstream(_files.front(), std::ios::binary);
        _name = std::move(_files.front());
        _files.pop_front();
        _line = 0;
    }
    return true;
}

/// The next line of the open file. False at its end: the last line may lack its end. False also after a line that is too long, with
/// the fault.
bool ReplayFiles::TryReadRest(std::string& line)
{
    line.clear();
    ++_line;
    std::array<char, PIECE_BYTES> piece{};
    while (true)
    {
        _file.getline(piece.data(), piece.size());
        const auto count = static_cast<std::size_t>(_file.gcount());
        if (_file.eof() || _file.bad() || count == 0)
        {
            return false;
        }
        if (!_file.fail())
        {
            line.append(piece.data(), count - 1); // without its end
            return true;
        }
        _file.clear();
        line.append(piece.data(), count);
        if (line.size() > _longestLine)
        {
            SetFault(fmt::format("the line is longer than {} bytes", _longestLine));
            _file.close();
            return false;
        }
    }
}

} // namespace ACS::Acsd
