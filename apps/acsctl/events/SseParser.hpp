#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Acsctl
{

/// One event of a stream of server-sent events.
struct SseEvent
{
    std::string type; ///< "message" if the stream names none.
    std::string id;   ///< That of the last event which had one.
    std::string data;
};

/// Reads a stream of server-sent events (text/event-stream) as it arrives, in parts of any size.
class SseParser final
{
public:
    /// Longest line, and longest data of an event.
    static constexpr std::size_t MAX_BYTES = 32U * 1024U * 1024U;

private:
    std::string _line;
    std::string _type;
    std::string _id;
    std::string _data;
    bool _bHasData = false;
    bool _bAfterReturn = false; ///< A line feed next belongs to the line end before it.
    bool _bAtStart = true;

public:
    /// Appends the events that are complete. Returns false if the stream exceeds MAX_BYTES; it is of no use then.
    [[nodiscard]] bool TryRead(std::string_view part, std::vector<SseEvent>& out);

private:
    void EndLine(std::vector<SseEvent>& out);
    void ReadField(std::string_view name, std::string_view value);
};

} // namespace ACS::Acsctl
