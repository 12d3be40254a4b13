#pragma once

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

/// One JSON object a line, both ways. Total: any bytes give a message or an Error. Keeps its buffers between calls; not
/// shared between threads. What encodes appends a whole line, with its end, to a string that the caller reuses.
class OpenStreamCodec
{
    struct Scratch;

    std::unique_ptr<Scratch> _scratch;

public:
    OpenStreamCodec();
    OpenStreamCodec(const OpenStreamCodec&) = delete;
    OpenStreamCodec& operator=(const OpenStreamCodec&) = delete;
    OpenStreamCodec(OpenStreamCodec&&) noexcept;
    OpenStreamCodec& operator=(OpenStreamCodec&&) noexcept;
    ~OpenStreamCodec();

    /// First half of reading a request: is it JSON, an object, a known command? A server asks its state between the two
    /// halves, so that handshake_required goes before what is wrong with the payload. The error's code is always an
    /// EOpenStreamErrorCode: InvalidNdjson or InvalidCmd.
    [[nodiscard]] Core::Result<EOpenStreamCommand> ReadCommand(std::string_view line);

    /// Second half, for the line of the last successful ReadCommand, which must still be there: payload, then url,
    /// method, period, args, body. The code of the first thing that is wrong.
    [[nodiscard]] Core::Result<OpenStreamRequest> ReadRequest();

    /// Both halves.
    [[nodiscard]] Core::Result<OpenStreamRequest> DecodeRequest(std::string_view line);

    /// Reads a line of a server: the member `error` first, then `type`. Errors are those of ACS::Core.
    [[nodiscard]] Core::Result<OpenStreamLine> DecodeLine(std::string_view line);

    static void EncodeRequest(const OpenStreamRequest& request, std::string& out);
    static void EncodeLine(const OpenStreamLine& line, std::string& out);

    /// A data line straight from the answer of a service, without a copy of it.
    static void EncodeData(
        std::int64_t ts,
        double serviceDurationMs,
        const ApiResponse& response,
        const std::optional<Core::JsonText>& id,
        std::string& out);
};

/// Whether a url may stand in MONITOR or CONTROL: begins with '/', no blank or control character. Not its length.
[[nodiscard]] bool IsUrl(std::string_view url) noexcept;

} // namespace ACS::OpenStream
