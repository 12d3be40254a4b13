#pragma once

#include <cstdint>
#include <string_view>
#include <system_error>

namespace ACS::OpenStream
{

/// The codes of an error line of the Open Stream, and what is wrong with a request. The numbers are stable: they appear
/// in logs and metrics; on the wire stands the text of GetErrorText.
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
    MissingField = 10, ///< Generic forms: understood, never sent by ServerSession, which sends the specific codes.
    InvalidType = 11,
    InvalidValue = 12,
    MissingMajor = 13,
    InvalidMajorType = 14,
    InvalidVersion = 15,
    MissingUrl = 16,
    InvalidUrl = 17,
    UrlTooLong = 18,
    MissingMethod = 19,
    InvalidMethod = 20,
    MissingPeriodMs = 21,
    InvalidPeriod = 22,
    InvalidArgs = 23,
    InvalidBody = 24,
    MonitorAlreadyActive = 25,
    MonitorInternalError = 26,
    MethodNotAllowed = 27, ///< A synonym of InvalidMethod in CONTROL: understood, never sent.
    ControlBusy = 28,
    ControlErr = 29, ///< A line type of its own (ControlError); as an error code only understood.
    MissingTarget = 30,
    InvalidTarget = 31,
    NothingToStop = 32,
    StopFailed = 33,
    Unknown = 34, ///< A code that this table does not have; never sent.
};

/// What an error line means to the client that reads it.
enum class EErrorScope : std::uint8_t
{
    Session, ///< Whatever was asked; the connection goes on.
    Monitor, ///< The MONITOR, its request or its stream.
    Control, ///< A CONTROL.
    Stop,    ///< A STOP.
    Request, ///< A MONITOR or a CONTROL: the line does not say which.
    Fatal,   ///< The session is over: only a new connection helps.
};

/// The code as it stands on the wire ("handshake_required").
[[nodiscard]] std::string_view GetErrorText(EOpenStreamErrorCode code) noexcept;
/// The HTTP status that the manual gives the code, ours where it gives none. It is in no error line.
[[nodiscard]] int GetErrorStatus(EOpenStreamErrorCode code) noexcept;
[[nodiscard]] EErrorScope GetErrorScope(EOpenStreamErrorCode code) noexcept;
/// Unknown where the table has no such text.
[[nodiscard]] EOpenStreamErrorCode GetErrorCode(std::string_view text) noexcept;

[[nodiscard]] std::error_code make_error_code(EOpenStreamErrorCode code) noexcept;

} // namespace ACS::OpenStream

template <>
struct std::is_error_code_enum<ACS::OpenStream::EOpenStreamErrorCode> : std::true_type
{
};
