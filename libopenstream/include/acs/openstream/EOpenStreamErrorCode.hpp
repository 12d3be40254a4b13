#pragma once

#include <acs/core/Api.hpp>

#include <cstdint>
#include <string_view>
#include <system_error>

namespace ACS::OpenStream
{

/// The codes of error lines and of invalid requests. The numbers are stable, for logs and metrics; the wire carries the
/// text of GetErrorText.
enum class EOpenStreamErrorCode
{
    InvalidNdjson = 1,     ///< The line is not a JSON object, not UTF-8, too deep, or repeats a member.
    RxBufOverflow = 2,     ///< The line is longer than the limit of the server, which then closes.
    HandshakeRequired = 3, ///< A command before HANDSHAKE.
    VersionMismatch = 4,   ///< The server has another major version.
    BusySessionActive = 5, ///< HANDSHAKE while a MONITOR or a CONTROL is active.
    HandshakeRejected = 6, ///< The server has no room or ends; it then closes.
    SessionTimeout = 7,    ///< No command or no data line in time; the server then closes.
    InvalidCmd = 8,        ///< `cmd` is missing or not a command.
    InvalidPayload = 9,    ///< `payload` is missing or not an object.
    MissingField = 10,     ///< Generic form: read, but never sent; ServerSession sends the specific codes.
    InvalidType = 11,      ///< Generic form, as MissingField.
    InvalidValue = 12,     ///< Generic form, as MissingField.
    MissingMajor = 13,     ///< HANDSHAKE without `major`.
    InvalidMajorType = 14, ///< `major` is not an integer.
    InvalidVersion = 15,   ///< `major` is negative.
    MissingURL = 16,       ///< MONITOR or CONTROL without `url`.
    InvalidURL = 17,       ///< `url` is not a string, does not begin with '/', or has a blank or a control character.
    UrlTooLong = 18,       ///< `url` is longer than LONGEST_URL.
    MissingMethod = 19,    ///< MONITOR or CONTROL without `method`.
    InvalidMethod = 20,    ///< Not GET for a MONITOR; not POST, PUT or DELETE for a CONTROL.
    MissingPeriodMs = 21,  ///< MONITOR without `period_ms`.
    InvalidPeriod = 22,    ///< `period_ms` is not an integer.
    InvalidArgs = 23,      ///< `args` is not an object.
    InvalidBody = 24,      ///< `body` is neither an object nor an array.
    MonitorAlreadyActive = 25, ///< A server that does not replace its MONITOR got another one.
    MonitorInternalError = 26, ///< The service failed; the MONITOR continues.
    MethodNotAllowed = 27,     ///< Synonym of InvalidMethod in CONTROL: read, but never sent.
    ControlBusy = 28,          ///< The queue of CONTROLs is full.
    ControlErr = 29,           ///< Has its own line type (ControlError); as an error code read, but never sent.
    MissingTarget = 30,        ///< STOP without `target`.
    InvalidTarget = 31,        ///< `target` is not an EStopTarget.
    NothingToStop = 32,        ///< No MONITOR is active, or no CONTROL was sent.
    StopFailed = 33,           ///< The service could not stop; the session has ended.
    Unknown = 34,              ///< A code that is not in this table; never sent.
};

/// What an error line refers to.
enum class EErrorScope : std::uint8_t
{
    Session, ///< Any command; the connection continues.
    Monitor, ///< The MONITOR, its request or its stream.
    Control, ///< A CONTROL.
    Stop,    ///< A STOP.
    Request, ///< A MONITOR or a CONTROL; the line does not identify it.
    Fatal,   ///< The session has ended; a new connection is required.
};

/// The code on the wire ("handshake_required").
[[nodiscard]] ACS_API std::string_view GetErrorText(EOpenStreamErrorCode code) noexcept;
/// The HTTP status of the code in the manual, or a suitable one. Error lines do not carry it.
[[nodiscard]] ACS_API int GetErrorStatus(EOpenStreamErrorCode code) noexcept;
/// What an error line with this code refers to.
[[nodiscard]] ACS_API EErrorScope GetErrorScope(EOpenStreamErrorCode code) noexcept;
/// Unknown if the text is not in the table.
[[nodiscard]] ACS_API EOpenStreamErrorCode GetErrorCode(std::string_view text) noexcept;

/// Makes the enumerators convertible to std::error_code.
[[nodiscard]] ACS_API std::error_code make_error_code(EOpenStreamErrorCode code) noexcept;

} // namespace ACS::OpenStream

template <>
struct std::is_error_code_enum<ACS::OpenStream::EOpenStreamErrorCode> : std::true_type
{
};
