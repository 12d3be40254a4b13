#pragma once

#include "console/RobotBoard.hpp"
#include "floor/FloorChecker.hpp"
#include "plans/PlannedPlan.hpp"
#include "plans/PlanTracker.hpp"
#include "SimulatorOptions.hpp"
#include "wire/MemberJudge.hpp"
#include "wire/NoteJudge.hpp"
#include "wire/TimestampJudge.hpp"
#include <acs/protocol/AcsCodec.hpp>
#include <acs/protocol/SessionEvent.hpp>

#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ACS::McsSim
{

/// Judges what the ACS reports: against the protocol, against its own reports before, and against the world if there is one.
class RunJudge final
{
    using Transaction = std::pair<Protocol::EAcsCommand, std::string>;

    PlanTracker::Lines& _lines;
    PlanTracker _tracker;
    std::optional<FloorChecker> _floor; ///< If there is a world.
    RobotBoard _board;
    NoteJudge _notes;
    TimestampJudge _timestamps;
    MemberJudge _members;
    Protocol::AcsCodec _codec;
    std::deque<Transaction>
        _unanswered;                   ///< No Ack in time, on this connection. Those of plans are the tracker's to see.
    std::deque<Transaction> _lostAcks; ///< They came, and were not read.

public:
    /// The world, if there is one, and the lines, which the judge appends to, outlive the judge.
    RunJudge(const SimulatorOptions& options, std::vector<PlannedPlan> plans, PlanTracker::Lines& lines);
    RunJudge(const RunJudge&) = delete;
    RunJudge& operator=(const RunJudge&) = delete;
    ~RunJudge() = default;

    [[nodiscard]] PlanTracker& GetTracker() noexcept;
    [[nodiscard]] RobotBoard& GetBoard() noexcept;
    [[nodiscard]] NoteJudge& GetNotes() noexcept;
    [[nodiscard]] FloorChecker* GetFloorOrNull() noexcept;
    [[nodiscard]] const TimestampCounts& GetTimestampCounts() const noexcept;
    [[nodiscard]] const MemberJudge& GetMembers() const noexcept;

    /// Any text that is sent to the ACS.
    void OnTextSent(std::string_view text);
    /// Any text that comes from an ACS.
    void OnTextReceived(std::string_view text);
    /// One of these that is not read, through no fault of the ACS.
    void OnTextLost(std::string_view text);
    void OnRequest(const Protocol::RequestReceived& received);
    void OnAck(const Protocol::AckReceived& received);
    void OnUnanswered(const Protocol::RequestUnanswered& unanswered);
    void OnNoted(const Protocol::ProtocolNoted& noted);
    /// Not for the link that the end of the run closes.
    void OnLinkLost();

    /// After each event.
    void EndPlans();

    /// At the end of the run.
    void Finish();
};

} // namespace ACS::McsSim
