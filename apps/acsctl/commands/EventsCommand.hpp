#pragma once

#include "commands/CommandError.hpp"
#include "commands/Session.hpp"
#include "events/SseParser.hpp"
#include "options/AcsctlOptions.hpp"
#include "terminal/Terminal.hpp"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Acsctl
{

/// `events`: the newest events that acsd still has, and with --follow those that come.
class EventsCommand final
{
    enum class EEnd : std::uint8_t
    {
        Stopped,   ///< The last wanted event was read.
        Reset,     ///< acsd no longer has the events after the wanted one.
        Ended,     ///< acsd has ended the stream.
        Refused,   ///< acsd has no stream now: it does not lead, or too many streams are open.
        Malformed, ///< An event cannot be read.
    };

    Session& _session;
    const AcsctlOptions& _options;
    Terminal& _terminal;
    std::string _types;
    std::optional<std::uint64_t> _after;
    const std::size_t _maxHistory;
    std::deque<std::string> _history;    ///< The newest lines of the history, shown when it is read.
    std::optional<std::uint64_t> _until; ///< The last event of the history while it is read.
    std::uint64_t _newest = 0;           ///< The newest event that acsd has, when the history was read.
    bool _bConnected = false;            ///< acsd has answered: from then on a lost stream is opened again.
    EEnd _end = EEnd::Ended;
    std::string _fault;

public:
    EventsCommand(Session& session, const AcsctlOptions& options, Terminal& terminal);

    /// Returns when all is shown; with --follow when the operator interrupts it.
    [[nodiscard]] Outcome<void> Run();

private:
    /// What is shown of a history without events.
    [[nodiscard]] std::string MakeEmptyText() const;
    [[nodiscard]] Outcome<void> RunHistory();
    /// All events that acsd still has.
    [[nodiscard]] Outcome<void> ReadAll();
    [[nodiscard]] Outcome<void> Follow();
    /// One request, until its end.
    [[nodiscard]] Outcome<void> ReadOnce();
    [[nodiscard]] Outcome<std::uint64_t> ReadNewest();
    [[nodiscard]] bool TryHandle(const SseEvent& event);
    [[nodiscard]] bool TryShow(const SseEvent& event);
};

} // namespace ACS::Acsctl
