#pragma once

#include "common/http/HttpBodyStream.hpp"
#include "common/http/HttpMessage.hpp"
#include "operator/EventRing.hpp"
#include <acs/core/Now.hpp>

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Acsd
{

/// Sends events to the clients of GET /v1/events. A client gets all events after the one that it had last, or `reset` if they
/// are not known any more. Used on the executor's thread; starts no timer of its own.
class EventFeed final
{
public:
    /// How often the owner calls KeepAlive.
    static constexpr std::chrono::seconds KEEP_ALIVE{15};
    /// Maximum duration of a stream: the client connects again and is identified again.
    static constexpr std::chrono::hours LONGEST_STREAM{1};

private:
    struct Position
    {
        std::uint64_t eventID = 0; ///< The last one that was sent.
        bool bGreeted = false;
        bool bKeepAliveDue = false;
    };

    struct Subscriber
    {
        std::shared_ptr<Position> position; ///< Also of the stream's source.
        std::shared_ptr<Apps::HttpBodyStream> stream;
        Core::SteadyTime openedAt;
    };

    const Core::IClock& _clock;
    std::function<void()> _requestFlush;
    EventRing _ring;
    std::vector<Subscriber> _subscribers;
    bool _bFlushRequested = false;

public:
    /// requestFlush is called when Flush has to be called, soon but not within this call: events that are published together
    /// are sent together. The clock outlives the feed.
    EventFeed(const Core::IClock& clock, std::function<void()> requestFlush, EventRing::Limits limits = {});
    EventFeed(const EventFeed&) = delete;
    EventFeed& operator=(const EventFeed&) = delete;

    /// Ends all streams.
    ~EventFeed();

    /// Returns the number of the event. The type is a word, the data is JSON.
    std::uint64_t Publish(std::string_view type, std::string_view json);

    /// The number of the newest event: the state that is read now includes all events up to it.
    [[nodiscard]] std::uint64_t GetLastID() const noexcept;

    /// The response to GET /v1/events?after=N or with the header Last-Event-ID.
    [[nodiscard]] Apps::HttpResponse Respond(const Apps::HttpRequest& request);

    void Flush();
    void KeepAlive();

    /// Clients connect again, and are identified again.
    void EndAll();

private:
    [[nodiscard]] std::string TakeNext(Position& position) const;
};

} // namespace ACS::Acsd
