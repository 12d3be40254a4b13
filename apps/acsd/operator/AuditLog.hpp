#pragma once

#include "common/config/Endpoint.hpp"
#include "common/http/HttpMessage.hpp"
#include "common/trace/NewestLines.hpp"
#include "common/trace/TraceWriter.hpp"
#include "operator/AccessPolicy.hpp"
#include "operator/CommandKey.hpp"
#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>
#include <acs/core/Result.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace ACS::Acsd
{

/// A command of an operator and its outcome.
struct AuditEntry
{
    const Apps::HttpRequest& request;
    const OperatorIdentity& identity;
    const Apps::HttpResponse& response;
    CommandKey key{};
};

/// The entry as one line of JSON, without its end. Long texts of the client are cut.
[[nodiscard]] std::string MakeAuditLine(const AuditEntry& entry, Core::Now now);

/// Records every command of an operator in files of bounded size and number, mode 0600, and keeps the newest lines in memory.
/// The files are written on a thread of their own. Used on one thread, the executor's.
class AuditLog final
{
    const Core::IClock& _clock;
    Apps::NewestLines _newest;
    Apps::TraceWriter _writer;

    AuditLog(
        const std::string& directory,
        const Apps::TraceLimits& limits,
        const Core::IClock& clock,
        Core::Logger logger);

public:
    /// Opens a file in the directory, which is created with mode 0700 if necessary, and reads the newest lines. The error is a
    /// sentence. Clock and the logger's sink outlive the log.
    [[nodiscard]] static Core::Result<std::unique_ptr<AuditLog>> Create(
        const std::string& directory,
        const Apps::TraceLimits& limits,
        const Core::IClock& clock,
        Core::Logger logger);

    void Write(const AuditEntry& entry);

    [[nodiscard]] const Apps::NewestLines& GetNewest() const noexcept;

    /// Logs that the files cannot be written, or are written again, if that is new. Write does so too.
    void LogState();

    /// Lines that are missing in the files.
    [[nodiscard]] std::uint64_t GetLost() const;
};

} // namespace ACS::Acsd
