#include "commands/EventsCommand.hpp"

#include "api/ApiCodec.hpp"
#include "commands/Answers.hpp"
#include "common/config/CommandLine.hpp"
#include "events/EventText.hpp"
#include "view/DisplayText.hpp"
#include <acs/core/ParseNumber.hpp>
#include <acs/core/Result.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

namespace ACS::Acsctl
{

namespace
{

constexpr std::uint64_t DEFAULT_EVENTS = 100;
/// acsd keeps at most this number of events, those of other types among them.
constexpr std::uint64_t MOST_EVENTS_OF_ACSD = 4'096;
constexpr std::chrono::milliseconds RECONNECT{2'000};
constexpr unsigned STATUS_UNAVAILABLE = 503;

} // namespace

EventsCommand::EventsCommand(Session& session, const AcsctlOptions& options, Terminal& terminal)
    : _session(session),
      _options(options),
      _terminal(terminal),
      _types(options.arguments.types.value_or("entry")),
      _after(options.arguments.after),
      _maxHistory(options.arguments.limit.value_or(_after.has_value() ? MOST_EVENTS_OF_ACSD : DEFAULT_EVENTS))
{
}

Outcome<void> EventsCommand::Run()
{
    const bool bFollow = _options.arguments.bFollow || _options.watch.has_value();
    if (bFollow)
    {
        _session.GetLoop().CatchInterrupts();
    }
    if (!bFollow || _options.arguments.limit.has_value())
    {
        Outcome<void> done = RunHistory();
        _until.reset();
        for (const std::string& line : _history)
        {
            _terminal.Write(line);
        }
        if (done.has_value() && !bFollow && !_options.bJSON && _history.empty())
        {
            _terminal.Write(MakeEmptyText());
        }
        if (!done.has_value() || !bFollow)
        {
            return done;
        }
    }
    return Follow();
}

std::string EventsCommand::MakeEmptyText() const
{
    if (!_options.arguments.after.has_value())
    {
        return "No events.\n";
    }
    const bool bBeyond = *_options.arguments.after > _newest;
    return fmt::format(
        "No events after {}{}.\n",
        *_options.arguments.after,
        bBeyond ? fmt::format("; the newest is {}", _newest) : std::string());
}

Outcome<void> EventsCommand::RunHistory()
{
    const Outcome<std::uint64_t> newest = ReadNewest();
    if (!newest.has_value())
    {
        return tl::make_unexpected(newest.error());
    }
    _bConnected = true;
    _until = *newest;
    _newest = *newest;
    if (_after.has_value())
    {
        Outcome<void> done = *_after < *newest ? ReadOnce() : Outcome<void>();
        return done.has_value() && _end == EEnd::Reset
            ? FailWith(EXIT_REFUSED, fmt::format("acsd no longer has all events after {}", *_after))
            : done;
    }
    return ReadAll();
}

Outcome<void> EventsCommand::ReadAll()
{
    // acsd does not state how many events it has: it answers with reset when they are fewer.
    std::uint64_t had = 0;
    std::uint64_t lacked = std::min(MOST_EVENTS_OF_ACSD, _newest) + 1;
    std::deque<std::string> all;
    for (std::uint64_t count = lacked - 1; count != had; count = had + (lacked - had) / 2)
    {
        _after = _newest - count;
        _history.clear();
        Outcome<void> done = ReadOnce();
        if (!done.has_value())
        {
            return done;
        }
        if (_end == EEnd::Reset)
        {
            lacked = count;
        }
        else
        {
            had = count;
            all = std::move(_history);
        }
    }
    _history = std::move(all);
    _after = _newest;
    return {};
}

Outcome<void> EventsCommand::Follow()
{
    EventLoop& loop = _session.GetLoop();
    if (!_after.has_value())
    {
        // Without it, what happens before the first event would be lost at a new connection.
        const Outcome<std::uint64_t> newest = ReadNewest();
        if (!newest.has_value())
        {
            return loop.IsInterrupted() ? Outcome<void>() : tl::make_unexpected(newest.error());
        }
        _bConnected = true;
        _after = *newest;
    }
    while (!loop.IsInterrupted() && !_terminal.IsFailed())
    {
        Outcome<void> done = ReadOnce();
        if (loop.IsInterrupted())
        {
            break;
        }
        _bConnected = _bConnected || done.has_value();
        if (!done.has_value())
        {
            const bool bPassing = done.error().exitCode == EXIT_NO_CONNECTION || _end == EEnd::Refused;
            if (!_bConnected || !bPassing)
            {
                return done;
            }
            Apps::PrintError(PROGRAM_NAME, MakeDisplayable(done.error().text) + "; connecting again");
        }
        loop.Pause(RECONNECT);
    }
    return {};
}

Outcome<void> EventsCommand::ReadOnce()
{
    _end = EEnd::Ended;
    SseParser parser;
    ApiRequest request;
    request.target = "/v1/events" + (_after.has_value() ? fmt::format("?after={}", *_after) : std::string());
    const auto tryHandle = [this, &parser](std::string_view part) {
        std::vector<SseEvent> events;
        if (!parser.TryRead(part, events))
        {
            _end = EEnd::Malformed;
            _fault = "an event is too long";
            return false;
        }
        return std::ranges::all_of(events, [this](const SseEvent& event) { return TryHandle(event); });
    };
    const tl::expected<ApiAnswer, ApiFailure> answer = _session.GetAPI().Stream(request, tryHandle);
    if (!answer.has_value())
    {
        _bConnected = _bConnected || answer.error().bStreaming;
        return tl::make_unexpected(MakeError(answer.error(), false));
    }
    if (_end == EEnd::Malformed)
    {
        return FailWith(EXIT_BAD_ANSWER, "the answer is not one of acsd's operator API: " + _fault);
    }
    if (const Outcome<std::string> body = GetBody(*answer); !body.has_value())
    {
        _end = answer->status == STATUS_UNAVAILABLE ? EEnd::Refused : _end;
        return tl::make_unexpected(body.error());
    }
    if (!answer->contentType.starts_with("text/event-stream"))
    {
        return FailWith(EXIT_BAD_ANSWER, "the answer is not a stream of events but " + answer->contentType);
    }
    return {};
}

Outcome<std::uint64_t> EventsCommand::ReadNewest()
{
    const Outcome<std::string> body = Get(_session.GetAPI(), "/v1/snapshot");
    if (!body.has_value())
    {
        return tl::make_unexpected(body.error());
    }
    const Core::Result<SnapshotAnswer> snapshot = DecodeAnswer<SnapshotAnswer>(*body);
    if (!snapshot.has_value())
    {
        return MakeBadAnswer(snapshot.error());
    }
    return snapshot->eventID;
}

bool EventsCommand::TryHandle(const SseEvent& event)
{
    if (event.type == "reset")
    {
        _end = EEnd::Reset;
        _history.clear();
        if (_until.has_value())
        {
            return false;
        }
        Apps::PrintError(PROGRAM_NAME, "events before this line are lost");
        return !_options.bJSON || TryShow(event);
    }
    const std::optional<std::uint64_t> number = Core::ParseNumberOrNull<std::uint64_t>(event.id);
    _after = number.has_value() ? number : _after;
    if (_types.find(event.type) != std::string::npos && !TryShow(event))
    {
        return false;
    }
    const bool bLast = _until.has_value() && number.has_value() && *number >= *_until;
    _end = bLast ? EEnd::Stopped : _end;
    return !bLast && !_terminal.IsFailed();
}

bool EventsCommand::TryShow(const SseEvent& event)
{
    const Core::Result<std::string> line =
        _options.bJSON ? MakeEventJSON(event) : MakeEventLine(event, _terminal.GetScreen());
    if (!line.has_value())
    {
        _end = EEnd::Malformed;
        _fault = Core::Describe(line.error());
        return false;
    }
    if (!_until.has_value())
    {
        _terminal.Write(*line);
        return true;
    }
    _history.push_back(*line);
    if (_history.size() > _maxHistory)
    {
        _history.pop_front();
    }
    return true;
}

} // namespace ACS::Acsctl
