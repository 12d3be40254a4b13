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
    InvalidNdjson = 1,
    RxBufOverflow = 2,
    HandshakeRequired = 3,
    VersionMismatch = 4,
    BusySessionActive = 5,
    HandshakeRejected = 6,
    SessionTimeout = 7,
    InvalidCmd = 8,
    InvalidPayload = 9,
    MissingField = 10, ///< Generic form: read, but never sent; ServerSession sends the specific codes.
    InvalidType = 11,
    InvalidValue = 12,
    MissingMajor = 13,
    InvalidMajorType = 14,
    InvalidVersion = 15,
    MissingURL = 16,
    InvalidURL = 17,
    UrlTooLong = 18,
    MissingMethod = 19,
    InvalidMethod = 20,
    MissingPeriodMs = 21,
    InvalidPeriod = 22,
    InvalidArgs = 23,
    InvalidBody = 24,
    MonitorAlreadyActive = 25,
    MonitorInternalError = 26,
    MethodNotAllowed = 27, ///< Synonym of InvalidMethod in CONTROL: read, but never sent.
    ControlBusy = 28,
    ControlErr = 29, ///< Has its own line type (ControlError); as an error code read, but never sent.
    MissingTarget = 30,
    InvalidTarget = 31,
    NothingToStop = 32,
    StopFailed = 33,
    Unknown = 34, ///< A code that is not in this table; never sent.
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
