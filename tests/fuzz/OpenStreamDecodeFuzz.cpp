#include "FuzzCheck.hpp"
#include "LineFramer.hpp"
#include <acs/openstream/OpenStreamCodec.hpp>

#include <algorithm>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace
{

using namespace ACS; // NOLINT(google-build-using-namespace)

void CheckLine(OpenStream::OpenStreamCodec& codec, std::string_view line)
{
    const Core::Result<OpenStream::OpenStreamRequest> request = codec.DecodeRequest(line);
    if (request)
    {
        std::string text;
        OpenStream::OpenStreamCodec::EncodeRequest(*request, text);
        text.resize(text.find_last_not_of("\r\n") + 1);
        Fuzz::Require(codec.DecodeRequest(text).has_value(), "an encoded request can be decoded");
    }
    const Core::Result<OpenStream::OpenStreamLine> answer = codec.DecodeLine(line);
    if (answer)
    {
        std::string text;
        OpenStream::OpenStreamCodec::EncodeLine(*answer, text);
        text.resize(text.find_last_not_of("\r\n") + 1);
        Fuzz::Require(codec.DecodeLine(text).has_value(), "an encoded line can be decoded");
    }
}

/// The result of a framer for a stream.
struct Framing
{
    std::vector<std::string> lines;
    bool bOverflown = false;
    bool bPartial = false; ///< Has no meaning after an overflow.

    bool operator==(const Framing&) const = default;
};

/// The same rule for a complete stream.
Framing SplitWhole(std::string_view stream, std::size_t bound)
{
    Framing framing;
    for (std::size_t end = stream.find('\n'); end != std::string_view::npos; end = stream.find('\n'))
    {
        std::string_view line = stream.substr(0, end);
        stream.remove_prefix(end + 1);
        if (line.size() > bound)
        {
            framing.bOverflown = true;
            return framing;
        }
        if (!line.empty() && line.back() == '\r')
        {
            line.remove_suffix(1);
        }
        const auto isBlank = [](char letter) {
            return letter == ' ' || letter == '\t' || letter == '\r';
        };
        if (!std::ranges::all_of(line, isBlank))
        {
            framing.lines.emplace_back(line);
        }
    }
    framing.bOverflown = stream.size() > bound;
    framing.bPartial = !framing.bOverflown && !stream.empty();
    return framing;
}

/// Pieces of any length, each copied so that a later use of it is detected; sometimes lines are left for later.
Framing SplitInPieces(std::string_view stream, std::size_t bound, std::uint32_t seed)
{
    std::minstd_rand random(seed);
    OpenStream::LineFramer framer(bound);
    Framing framing;
    const auto take = [&framer, &framing](std::uint32_t limit) {
        for (std::uint32_t count = 0; count < limit; ++count)
        {
            const std::optional<std::string_view> line = framer.TakeLineOrNull();
            if (!line.has_value())
            {
                return;
            }
            framing.lines.emplace_back(*line);
        }
    };
    const std::size_t longest = 1U + random() % 100U;
    while (!stream.empty())
    {
        const std::string piece(stream.substr(0, 1U + random() % longest));
        stream.remove_prefix(piece.size());
        framer.Feed(piece);
        take(
            random() % 4U == 0U ? static_cast<std::uint32_t>(random() % 3U)
                                : std::numeric_limits<std::uint32_t>::max());
        framer.Keep();
    }
    take(std::numeric_limits<std::uint32_t>::max());
    framing.bOverflown = framer.HasOverflown();
    framing.bPartial = !framing.bOverflown && framer.HasPartialLine();
    Fuzz::Require(!framer.TakeLineOrNull().has_value(), "no line follows the end");
    return framing;
}

} // namespace

/// The first byte chooses the pieces of the stream and, besides the real one, the maximum length of a line.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    if (size == 0)
    {
        return 0;
    }
    const std::string_view stream = Fuzz::AsText(data, size).substr(1);
    for (const std::size_t bound : {OpenStream::LONGEST_LINE, std::size_t{data[0]}})
    {
        Fuzz::Require(
            SplitInPieces(stream, bound, 1U + data[0]) == SplitWhole(stream, bound),
            "a stream in pieces has the same lines as the whole");
    }
    OpenStream::OpenStreamCodec codec;
    for (const std::string& line : SplitWhole(stream, OpenStream::LONGEST_LINE).lines)
    {
        CheckLine(codec, line);
    }
    return 0;
}
