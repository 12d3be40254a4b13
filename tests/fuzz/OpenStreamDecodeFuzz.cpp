#include "FuzzCheck.hpp"
#include <acs/openstream/LineFramer.hpp>
#include <acs/openstream/OpenStreamCodec.hpp>

#include <optional>
#include <string>
#include <string_view>

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

} // namespace

/// The first byte says into which pieces the stream is cut, so that every split is tried.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    if (size == 0)
    {
        return 0;
    }
    const std::size_t piece = 1U + data[0];
    std::string_view rest = Fuzz::AsText(data, size).substr(1);
    OpenStream::OpenStreamCodec codec;
    OpenStream::LineFramer framer(OpenStream::LONGEST_LINE);
    while (!rest.empty())
    {
        framer.Feed(rest.substr(0, piece));
        while (const std::optional<std::string_view> line = framer.TakeLineOrNull())
        {
            Fuzz::Require(line->find('\n') == std::string_view::npos, "a line has no line end in it");
            CheckLine(codec, *line);
        }
        framer.Keep();
        rest.remove_prefix(std::min(piece, rest.size()));
    }
    return 0;
}
