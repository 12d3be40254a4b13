#include <acs/openstream/EOpenStreamErrorCode.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <string>

namespace ACS::OpenStream
{

namespace
{

struct ErrorRow
{
    EOpenStreamErrorCode code;
    std::string_view text;
    int status;
    EErrorScope scope;
};

constexpr std::array ERROR_TABLE{
    ErrorRow{EOpenStreamErrorCode::InvalidNdjson, "invalid_ndjson", 400, EErrorScope::Request},
    ErrorRow{EOpenStreamErrorCode::RxBufOverflow, "rx_buf_overflow", 413, EErrorScope::Fatal},
    ErrorRow{EOpenStreamErrorCode::HandshakeRequired, "handshake_required", 412, EErrorScope::Fatal},
    ErrorRow{EOpenStreamErrorCode::VersionMismatch, "version_mismatch", 400, EErrorScope::Session},
    ErrorRow{EOpenStreamErrorCode::BusySessionActive, "busy_session_active", 409, EErrorScope::Session},
    ErrorRow{EOpenStreamErrorCode::HandshakeRejected, "handshake_rejected", 409, EErrorScope::Fatal},
    ErrorRow{EOpenStreamErrorCode::SessionTimeout, "session_timeout", 408, EErrorScope::Fatal},
    ErrorRow{EOpenStreamErrorCode::InvalidCmd, "invalid_cmd", 400, EErrorScope::Request},
    ErrorRow{EOpenStreamErrorCode::InvalidPayload, "invalid_payload", 400, EErrorScope::Request},
    ErrorRow{EOpenStreamErrorCode::MissingField, "missing_field", 400, EErrorScope::Request},
    ErrorRow{EOpenStreamErrorCode::InvalidType, "invalid_type", 400, EErrorScope::Request},
    ErrorRow{EOpenStreamErrorCode::InvalidValue, "invalid_value", 400, EErrorScope::Request},
    ErrorRow{EOpenStreamErrorCode::MissingMajor, "missing_major", 400, EErrorScope::Session},
    ErrorRow{EOpenStreamErrorCode::InvalidMajorType, "invalid_major_type", 400, EErrorScope::Session},
    ErrorRow{EOpenStreamErrorCode::InvalidVersion, "invalid_version", 400, EErrorScope::Session},
    ErrorRow{EOpenStreamErrorCode::MissingURL, "missing_url", 400, EErrorScope::Request},
    ErrorRow{EOpenStreamErrorCode::InvalidURL, "invalid_url", 400, EErrorScope::Request},
    ErrorRow{EOpenStreamErrorCode::UrlTooLong, "url_too_long", 400, EErrorScope::Request},
    ErrorRow{EOpenStreamErrorCode::MissingMethod, "missing_method", 400, EErrorScope::Request},
    ErrorRow{EOpenStreamErrorCode::InvalidMethod, "invalid_method", 400, EErrorScope::Request},
    ErrorRow{EOpenStreamErrorCode::MissingPeriodMs, "missing_period_ms", 400, EErrorScope::Monitor},
    ErrorRow{EOpenStreamErrorCode::InvalidPeriod, "invalid_period", 400, EErrorScope::Monitor},
    ErrorRow{EOpenStreamErrorCode::InvalidArgs, "invalid_args", 400, EErrorScope::Request},
    ErrorRow{EOpenStreamErrorCode::InvalidBody, "invalid_body", 400, EErrorScope::Control},
    ErrorRow{EOpenStreamErrorCode::MonitorAlreadyActive, "monitor_already_active", 409, EErrorScope::Monitor},
    ErrorRow{EOpenStreamErrorCode::MonitorInternalError, "monitor_internal_error", 500, EErrorScope::Session},
    ErrorRow{EOpenStreamErrorCode::MethodNotAllowed, "method_not_allowed", 405, EErrorScope::Control},
    ErrorRow{EOpenStreamErrorCode::ControlBusy, "control_busy", 503, EErrorScope::Control},
    ErrorRow{EOpenStreamErrorCode::ControlErr, "control_err", 400, EErrorScope::Control},
    ErrorRow{EOpenStreamErrorCode::MissingTarget, "missing_target", 400, EErrorScope::Stop},
    ErrorRow{EOpenStreamErrorCode::InvalidTarget, "invalid_target", 400, EErrorScope::Stop},
    ErrorRow{EOpenStreamErrorCode::NothingToStop, "nothing_to_stop", 404, EErrorScope::Stop},
    ErrorRow{EOpenStreamErrorCode::StopFailed, "stop_failed", 500, EErrorScope::Fatal},
    ErrorRow{EOpenStreamErrorCode::Unknown, "unknown", 400, EErrorScope::Request},
};

static_assert(
    std::ranges::adjacent_find(
        ERROR_TABLE,
        [](const ErrorRow& left, const ErrorRow& right) {
            return static_cast<int>(left.code) + 1 != static_cast<int>(right.code);
        })
        == ERROR_TABLE.end(),
    "the table is in the order of the numbers");

const ErrorRow& GetRow(EOpenStreamErrorCode code) noexcept
{
    const std::size_t index = static_cast<std::size_t>(code) - 1;
    assert(index < ERROR_TABLE.size());
    return ERROR_TABLE[std::min(index, ERROR_TABLE.size() - 1)];
}

class ErrorCategory final : public std::error_category
{
public:
    [[nodiscard]] const char* name() const noexcept override
    {
        return "acs.openstream";
    }

    [[nodiscard]] std::string message(int value) const override
    {
        return std::string(GetErrorText(static_cast<EOpenStreamErrorCode>(value)));
    }
};

} // namespace

std::string_view GetErrorText(EOpenStreamErrorCode code) noexcept
{
    return GetRow(code).text;
}

int GetErrorStatus(EOpenStreamErrorCode code) noexcept
{
    return GetRow(code).status;
}

EErrorScope GetErrorScope(EOpenStreamErrorCode code) noexcept
{
    return GetRow(code).scope;
}

EOpenStreamErrorCode GetErrorCode(std::string_view text) noexcept
{
    const auto* const row = std::ranges::find(ERROR_TABLE, text, &ErrorRow::text);
    return row == ERROR_TABLE.end() ? EOpenStreamErrorCode::Unknown : row->code;
}

std::error_code make_error_code(EOpenStreamErrorCode code) noexcept
{
    static const ErrorCategory CATEGORY;
    return {static_cast<int>(code), CATEGORY};
}

} // namespace ACS::OpenStream
