#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/Result.hpp>
#include <acs/openstream/ApiRequest.hpp>
#include <acs/openstream/OpenStreamLines.hpp>
#include <acs/openstream/OpenStreamRequests.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace ACS::OpenStream
{

/// Encodes and decodes lines of one JSON object each. Any bytes result in a message or an Error. Reuses its buffers; not
/// shared between threads. Encoding appends a whole line, with its end, to a string that the caller reuses.
class ACS_API OpenStreamCodec
{
    struct ACS_HIDDEN Scratch;

    std::unique_ptr<Scratch> _scratch;

public:
    OpenStreamCodec();
    OpenStreamCodec(const OpenStreamCodec&) = delete;
    OpenStreamCodec& operator=(const OpenStreamCodec&) = delete;
    OpenStreamCodec(OpenStreamCodec&&) noexcept;
    OpenStreamCodec& operator=(OpenStreamCodec&&) noexcept;
    ~OpenStreamCodec();

    /// First step of reading a request: a JSON object with a known command. A server checks its state before the second
    /// step, so that handshake_required takes precedence over payload errors. The error's code is an EOpenStreamErrorCode:
    /// InvalidNdjson or InvalidCmd.
    [[nodiscard]] Core::Result<EOpenStreamCommand> ReadCommand(std::string_view line);

    /// Second step, for the line of the last successful ReadCommand, which must still be valid: checks payload, url, method,
    /// period, args and body in this order, and returns the first error.
    [[nodiscard]] Core::Result<OpenStreamRequest> ReadRequest();

    /// Both steps.
    [[nodiscard]] Core::Result<OpenStreamRequest> DecodeRequest(std::string_view line);

    /// Reads a line of a server: the member `error` first, then `type`. Errors are those of ACS::Core.
    [[nodiscard]] Core::Result<OpenStreamLine> DecodeLine(std::string_view line);

    /// Appends the line of a client. The request must be valid: the codec does not check it.
    static void EncodeRequest(const OpenStreamRequest& request, std::string& out);
    /// Appends the line of a server.
    static void EncodeLine(const OpenStreamLine& line, std::string& out);

    /// Encodes a data line from the answer of a service without copying it.
    static void EncodeData(
        std::int64_t ts,
        double serviceDurationMs,
        const ApiResponse& response,
        const std::optional<Core::JsonText>& idOrNull,
        std::string& out);
};

/// Whether a url is valid in MONITOR or CONTROL: begins with '/', no blank or control character. Ignores its length.
[[nodiscard]] ACS_API bool IsURL(std::string_view url) noexcept;

} // namespace ACS::OpenStream
