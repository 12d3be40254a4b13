#include "replay/RecordLine.hpp"

#include <acs/core/Timestamp.hpp>
#include <acs/json/TextCodec.hpp>

#include <chrono>
#include <string>
#include <utility>

namespace ACS::Acsd
{

namespace
{

constexpr std::string_view CORE_LINK = "core";
constexpr std::string_view STORE_LINK = "store";
constexpr std::string_view TRACE_LINK = "trace";
constexpr std::string_view IN_DIRECTION = "in";

struct LineText
{
    std::string time;
    std::int64_t steady = 0;
    std::string link;
    std::string direction;
    std::string kind;
    std::size_t depth = 0;
    std::string robotID;
    std::string planID;
    std::string transactionID;
    std::string text;
    std::uint64_t lost = 0;
};

} // namespace

} // namespace ACS::Acsd

namespace ACS::Json
{

template <>
struct JsonFields<Acsd::LineText>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("time", &Acsd::LineText::time),
        Required("mono_us", &Acsd::LineText::steady),
        Required("link", &Acsd::LineText::link),
        Optional("direction", &Acsd::LineText::direction),
        Optional("kind", &Acsd::LineText::kind),
        Defaulted("depth", &Acsd::LineText::depth),
        Optional("robot", &Acsd::LineText::robotID),
        Optional("plan", &Acsd::LineText::planID),
        Optional("transaction", &Acsd::LineText::transactionID),
        Optional("text", &Acsd::LineText::text),
        Defaulted("lost", &Acsd::LineText::lost));
};

} // namespace ACS::Json

namespace ACS::Acsd
{

namespace
{

using Line = std::optional<std::variant<CoreRecord, LostLines>>;

bool HasRecord(std::string_view link)
{
    return link == CORE_LINK || link == STORE_LINK || link == TRACE_LINK;
}

Core::Result<Line> MakeLine(LineText text)
{
    if (!HasRecord(text.link))
    {
        return Line();
    }
    if (text.link == TRACE_LINK)
    {
        return Line(LostLines{text.lost});
    }
    return Core::ParseTimestamp(text.time).map([&text](const Core::Timestamp& time) {
        CoreRecord record;
        record.now = {Core::SteadyTime(std::chrono::microseconds(text.steady)), time.time};
        record.bInput = text.direction == IN_DIRECTION;
        record.depth = text.depth;
        record.kind = std::move(text.kind);
        record.robotID = std::move(text.robotID);
        record.planID = std::move(text.planID);
        record.transactionID = std::move(text.transactionID);
        record.text = std::move(text.text);
        return Line(std::move(record));
    });
}

/// The link of a line that is written as acsd writes it; empty if it is not. Parsing the messages would take most of the time of a
/// replay.
std::string_view FindLink(std::string_view line)
{
    constexpr std::size_t BEFORE_TEXT = 120;
    constexpr std::string_view MEMBER = R"("link":")";
    std::string_view begin = line.substr(0, BEFORE_TEXT);
    const std::size_t at = begin.find(MEMBER);
    if (!line.starts_with(R"({"time":")") || !line.ends_with('}') || at == std::string_view::npos)
    {
        return {};
    }
    begin.remove_prefix(at + MEMBER.size());
    const std::size_t end = begin.find('"');
    return end == std::string_view::npos ? std::string_view() : begin.substr(0, end);
}

} // namespace

void WriteRecord(const CoreRecord& record, MessageTrace& trace)
{
    const bool bStore = !record.bInput && record.kind == STORE_LINK;
    const TraceEntry entry{
        bStore ? STORE_LINK : CORE_LINK,
        record.bInput ? ProtocolBeast::EWireDirection::In : ProtocolBeast::EWireDirection::Out,
        record.robotID,
        {},
        record.text,
        record.kind,
        record.planID,
        record.transactionID,
        record.depth};
    if (record.bInput && record.depth == 0)
    {
        trace.Add(entry, record.now, ETraceUse::FilesOnly); // a replay has this time
    }
    else
    {
        trace.Add(entry, bStore ? ETraceUse::All : ETraceUse::FilesOnly);
    }
}

Core::Result<std::optional<std::variant<CoreRecord, LostLines>>> ReadRecord(std::string_view line)
{
    const std::string_view link = FindLink(line);
    if (!link.empty() && !HasRecord(link))
    {
        return Line();
    }
    return Json::DecodeText<LineText>(line).and_then([](LineText&& text) { return MakeLine(std::move(text)); });
}

} // namespace ACS::Acsd
