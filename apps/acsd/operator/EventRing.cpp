#include "operator/EventRing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <iterator>
#include <utility>

namespace ACS::Acsd
{

namespace
{

/// A line break would end the event.
void AppendData(std::string_view json, std::string& text)
{
    while (true)
    {
        const std::size_t end = std::min(json.find_first_of("\r\n"), json.size());
        fmt::format_to(std::back_inserter(text), "data: {}\n", json.substr(0, end));
        if (end == json.size())
        {
            return;
        }
        json.remove_prefix(end + 1);
    }
}

} // namespace

EventRing::EventRing(std::uint64_t lastID, Limits limits)
    : _limits(limits),
      _lastID(lastID)
{
}

std::uint64_t EventRing::Add(std::string_view type, std::string_view json)
{
    ++_lastID;
    std::string text = fmt::format("event: {}\nid: {}\n", type, _lastID);
    AppendData(json, text);
    text += '\n';
    _bytes += text.size();
    _events.push_back(std::move(text));
    while (_events.size() > 1 && (_events.size() > _limits.maxEvents || _bytes > _limits.maxBytes))
    {
        _bytes -= _events.front().size();
        _events.pop_front();
    }
    return _lastID;
}

std::uint64_t EventRing::GetLastID() const noexcept
{
    return _lastID;
}

bool EventRing::HasAllAfter(std::uint64_t eventID) const noexcept
{
    return eventID <= _lastID && _lastID - eventID <= _events.size();
}

std::string EventRing::TakeAfter(std::uint64_t& eventID, std::size_t maxBytes) const
{
    assert(HasAllAfter(eventID));
    std::string text;
    while (eventID < _lastID)
    {
        const std::string& event = _events[_events.size() - (_lastID - eventID)];
        if (!text.empty() && text.size() + event.size() > maxBytes)
        {
            break;
        }
        text += event;
        ++eventID;
    }
    return text;
}

} // namespace ACS::Acsd
