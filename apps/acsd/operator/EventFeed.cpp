#include "operator/EventFeed.hpp"

#include "operator/OperatorAnswer.hpp"
#include <acs/core/ParseNumber.hpp>
#include <acs/core/Result.hpp>

#include <fmt/format.h>

#include <optional>
#include <utility>

namespace ACS::Acsd
{

namespace
{

constexpr unsigned STREAM_OPENED = 200;
constexpr unsigned STREAM_INVALID = 400;
constexpr unsigned STREAM_LIMIT_REACHED = 503;
constexpr std::chrono::seconds RETRY_STREAM{5};
constexpr std::size_t PIECE_BYTES = 64U * 1024U;
/// The time after which a browser connects again.
constexpr std::string_view GREETING = "retry: 2000\n\n";
constexpr std::string_view RESET = "event: reset\ndata: {}\n\n";
constexpr std::string_view KEEP_ALIVE_COMMENT = ": keep-alive\n\n";

std::uint64_t MakeStartID(Core::Now now)
{
    const auto sinceEpoch = std::chrono::duration_cast<std::chrono::microseconds>(now.wall.time_since_epoch());
    return static_cast<std::uint64_t>(sinceEpoch.count());
}

/// The number of the event after which the client continues; `newest` if it gives none. The error is a sentence.
tl::expected<std::uint64_t, std::string> ReadPosition(const Apps::HttpRequest& request, std::uint64_t newest)
{
    std::optional<std::string> text;
    for (const auto& [name, value] : request.query)
    {
        if (name != "after" || text.has_value())
        {
            return tl::make_unexpected(
                fmt::format("Expected no parameter but one after, found {}.", Core::QuoteForError(name)));
        }
        text = value;
    }
    // A browser that connects again sends the header with the address of its first request.
    if (std::optional<std::string> header = request.GetHeaderOrNull("Last-Event-ID"); header.has_value())
    {
        text = std::move(header);
    }
    if (!text.has_value())
    {
        return newest;
    }
    const std::optional<std::uint64_t> position = Core::ParseNumberOrNull<std::uint64_t>(*text);
    if (!position.has_value())
    {
        return tl::make_unexpected(fmt::format(
            "Expected the number of an event (after or Last-Event-ID), found {}.",
            Core::QuoteForError(*text)));
    }
    return *position;
}

} // namespace

EventFeed::EventFeed(const Core::IClock& clock, std::function<void()> requestFlush, EventRing::Limits limits)
    : _clock(clock),
      _requestFlush(std::move(requestFlush)),
      _ring(MakeStartID(clock.GetNow()), limits)
{
}

EventFeed::~EventFeed()
{
    EndAll();
}

std::uint64_t EventFeed::Publish(std::string_view type, std::string_view json)
{
    const std::uint64_t eventID = _ring.Add(type, json);
    if (!_subscribers.empty() && !std::exchange(_bFlushRequested, true))
    {
        _requestFlush();
    }
    return eventID;
}

std::uint64_t EventFeed::GetLastID() const noexcept
{
    return _ring.GetLastID();
}

Apps::HttpResponse EventFeed::Respond(const Apps::HttpRequest& request)
{
    const tl::expected<std::uint64_t, std::string> position = ReadPosition(request, _ring.GetLastID());
    if (!position.has_value())
    {
        return MakeOperatorError(STREAM_INVALID, position.error());
    }
    if (!request.bCanStream)
    {
        Apps::HttpResponse refusal = MakeOperatorError(STREAM_LIMIT_REACHED, "Too many event streams are open.");
        refusal.retryAfter = RETRY_STREAM;
        return refusal;
    }
    const auto state = std::make_shared<Position>();
    state->eventID = *position;
    Apps::HttpResponse response{STREAM_OPENED, "text/event-stream"};
    response.headers = {{"Cache-Control", "no-store"}};
    response.stream = std::make_shared<Apps::HttpBodyStream>([this, state] { return TakeNext(*state); });
    std::erase_if(_subscribers, [](const Subscriber& subscriber) { return !subscriber.stream->IsOpen(); });
    _subscribers.push_back({state, response.stream, _clock.GetNow().steady});
    return response;
}

void EventFeed::Flush()
{
    _bFlushRequested = false;
    for (const Subscriber& subscriber : _subscribers)
    {
        subscriber.stream->Notify();
    }
}

void EventFeed::KeepAlive()
{
    const Core::SteadyTime now = _clock.GetNow().steady;
    for (const Subscriber& subscriber : _subscribers)
    {
        if (now - subscriber.openedAt >= LONGEST_STREAM)
        {
            subscriber.stream->End();
            continue;
        }
        subscriber.position->bKeepAliveDue = true;
        subscriber.stream->Notify();
    }
    std::erase_if(_subscribers, [](const Subscriber& subscriber) { return !subscriber.stream->IsOpen(); });
}

void EventFeed::EndAll()
{
    for (const Subscriber& subscriber : std::exchange(_subscribers, {}))
    {
        subscriber.stream->End();
    }
}

std::string EventFeed::TakeNext(Position& position) const
{
    std::string text(std::exchange(position.bGreeted, true) ? std::string_view() : GREETING);
    if (!_ring.HasAllAfter(position.eventID))
    {
        text += RESET;
        position.eventID = _ring.GetLastID();
    }
    text += _ring.TakeAfter(position.eventID, PIECE_BYTES);
    if (std::exchange(position.bKeepAliveDue, false) && text.empty())
    {
        text = KEEP_ALIVE_COMMENT;
    }
    return text;
}

} // namespace ACS::Acsd
