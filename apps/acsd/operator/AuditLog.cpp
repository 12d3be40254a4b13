#include "operator/AuditLog.hpp"

#include "operator/LinesRoute.hpp"
#include <acs/core/JsonText.hpp>
#include <acs/core/Timestamp.hpp>

#include <fmt/format.h>

#include <filesystem>
#include <iterator>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace ACS::Acsd
{

namespace
{

/// Bytes of a text of the client.
constexpr std::size_t LONGEST_AUDIT_TEXT = 1'024;
/// In memory.
constexpr std::size_t MOST_BYTES = 8U * 1024U * 1024U;
constexpr mode_t AUDIT_MODE = 0600;
constexpr std::size_t AUDIT_QUEUE_BYTES = 4U * 1024U * 1024U;

void AppendText(std::string_view name, std::string_view text, std::string& line)
{
    fmt::format_to(std::back_inserter(line), R"(,"{}":)", name);
    Core::JsonText::AppendString(text.substr(0, LONGEST_AUDIT_TEXT), line);
}

/// Whether acsd does not have what the request is for. It may have been meant for /v1/login, which has a token.
bool IsMisdirected(const AuditEntry& entry)
{
    constexpr unsigned NOT_FOUND = 404;
    constexpr unsigned NOT_ALLOWED = 405;
    return entry.response.status == NOT_FOUND || entry.response.status == NOT_ALLOWED;
}

bool HasPublicBody(const AuditEntry& entry)
{
    return !entry.request.body.empty() && !IsMisdirected(entry) && entry.request.path != "/v1/login";
}

std::string_view GetPublicTarget(const AuditEntry& entry)
{
    const std::string_view target = entry.request.target;
    return IsMisdirected(entry) ? target.substr(0, target.find('?')) : target;
}

void BeginAuditLine(Core::Now now, std::string& line)
{
    fmt::format_to(std::back_inserter(line), R"({{"time":"{}")", Core::FormatUTC(now.wall));
}

std::string MakeAuditLossLine(std::uint64_t count, Core::Now now)
{
    std::string line;
    BeginAuditLine(now, line);
    fmt::format_to(std::back_inserter(line), R"(,"lost":{}}})", count);
    return line;
}

} // namespace

std::string MakeAuditLine(const AuditEntry& entry, Core::Now now)
{
    std::string line;
    BeginAuditLine(now, line);
    AppendText("peer", Apps::MakeText(entry.request.sender.peer), line);
    AppendText("proof", GetText(entry.identity.proof), line);
    AppendText("name", entry.identity.name, line);
    AppendText("role", GetText(entry.identity.role), line);
    AppendText("method", entry.request.method, line);
    AppendText("request", GetPublicTarget(entry), line);
    if (HasPublicBody(entry))
    {
        AppendText("body", entry.request.body, line);
    }
    if (!entry.key.key.empty())
    {
        AppendText("key", entry.key.key, line);
        AppendText("digest", entry.key.digest, line);
        line += entry.key.bReplay ? R"(,"replay":true)" : "";
    }
    fmt::format_to(std::back_inserter(line), R"(,"status":{})", entry.response.status);
    std::string_view answer = entry.response.body;
    answer = answer.substr(0, answer.find_last_not_of('\n') + 1);
    if (entry.response.contentType == "application/json" && answer.size() <= LONGEST_AUDIT_TEXT)
    {
        line += R"(,"answer":)";
        line += answer;
    }
    else
    {
        AppendText("answer", answer, line);
    }
    line += '}';
    return line;
}

AuditLog::AuditLog(
    const std::string& directory,
    const Apps::TraceLimits& limits,
    const Core::IClock& clock,
    Core::Logger logger)
    : _clock(clock),
      _newest(MOST_SHOWN_LINES, MOST_BYTES),
      _writer(
          {directory, limits, MakeAuditLossLine, AUDIT_QUEUE_BYTES, {"audit-", AUDIT_MODE, true}, "audit log"},
          clock,
          std::move(logger))
{
}

Core::Result<std::unique_ptr<AuditLog>> AuditLog::Create(
    const std::string& directory,
    const Apps::TraceLimits& limits,
    const Core::IClock& clock,
    Core::Logger logger)
{
    std::error_code error;
    if (std::filesystem::create_directory(directory, error))
    {
        std::filesystem::permissions(directory, std::filesystem::perms::owner_all, error);
    }
    // The constructor is private.
    std::unique_ptr<AuditLog> log(new AuditLog(directory, limits, clock, std::move(logger)));
    if (!error)
    {
        for (std::string& line : Apps::ReadNewestLines(directory, "audit-", MOST_SHOWN_LINES))
        {
            log->_newest.Add(std::move(line));
        }
        error = log->_writer.Open();
    }
    if (error)
    {
        return Core::Fail(
            error,
            "operator.audit.directory",
            "a directory that can be written, in one that exists",
            directory + ": " + error.message());
    }
    return log;
}

void AuditLog::Write(const AuditEntry& entry)
{
    const Core::Now now = _clock.GetNow();
    std::string line = MakeAuditLine(entry, now);
    _newest.Add(line);
    _writer.Write(std::move(line), now);
}

const Apps::NewestLines& AuditLog::GetNewest() const noexcept
{
    return _newest;
}

void AuditLog::LogState()
{
    _writer.LogState();
}

std::uint64_t AuditLog::GetLost() const
{
    return _writer.GetLost();
}

} // namespace ACS::Acsd
