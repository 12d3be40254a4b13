#include "SessionOutput.hpp"

#include <acs/core/Result.hpp>
#include <acs/protocol/EAcsCommand.hpp>

#include <utility>

namespace ACS::Protocol::Detail
{

void SessionOutput::Note(EProtocolNote what, std::string detail, SessionActions& out, std::uint32_t count)
{
    if (count != 0)
    {
        statistics.notes[static_cast<std::size_t>(what)] += count;
        out.emplace_back(Deliver{ProtocolNoted{what, count, std::move(detail)}});
    }
}

void SessionOutput::NoteAll(const DecodeNotes& notes, SessionActions& out)
{
    Note(EProtocolNote::UnknownMember, {}, out, notes.unknownMembers);
    Note(EProtocolNote::NullOptional, {}, out, notes.nullOptionals);
    Note(EProtocolNote::LenientWord, {}, out, notes.lenientWords);
    Note(EProtocolNote::LenientNumber, {}, out, notes.lenientNumbers);
    Note(EProtocolNote::BadTimestamp, {}, out, notes.badTimestamps);
}

void SessionOutput::Start(ESessionTimer timer, std::chrono::milliseconds delay, SessionActions& out)
{
    _running[static_cast<std::size_t>(timer)] = true;
    out.emplace_back(StartTimer{timer, delay});
}

void SessionOutput::Cancel(ESessionTimer timer, SessionActions& out)
{
    if (TryExpire(timer))
    {
        out.emplace_back(CancelTimer{timer});
    }
}

void SessionOutput::CancelAll(SessionActions& out)
{
    for (std::size_t index = 0; index < TIMER_COUNT; ++index)
    {
        Cancel(static_cast<ESessionTimer>(index), out);
    }
}

ERefusal SessionOutput::NoteFailure(const DecodeFailure& failure, bool bTakesFromMCS, SessionActions& out)
{
    const bool bForUs = failure.command.has_value() && IsSentByMCS(*failure.command) == bTakesFromMCS;
    const bool bKnown = failure.commandName.empty() || failure.bAck || bForUs;
    Note(bKnown ? EProtocolNote::Undecodable : EProtocolNote::UnknownCommand, Core::Describe(failure.error), out);
    const bool bHasAck = !failure.command.has_value() || HasAck(*failure.command);
    if (failure.commandName.empty() || failure.bAck || !bHasAck)
    {
        return ERefusal::None;
    }
    return bForUs ? ERefusal::Failed : ERefusal::Unsupported;
}

bool SessionOutput::TryExpire(ESessionTimer timer)
{
    return std::exchange(_running[static_cast<std::size_t>(timer)], false);
}

bool SessionOutput::IsRunning(ESessionTimer timer) const
{
    return _running[static_cast<std::size_t>(timer)];
}

Core::Timestamp MakeTimestamp(Core::Now now, std::chrono::minutes offset)
{
    return {std::chrono::floor<std::chrono::milliseconds>(now.wall), offset};
}

std::string MakeRefusal(const DecodeFailure& failure)
{
    return failure.command.has_value() ? Core::Describe(failure.error) : std::string(UNSUPPORTED);
}

AckPayload MakeRefusalPayload(const DecodeFailure& failure)
{
    if (failure.command.has_value() && *failure.command <= EAcsCommand::ResumePlan)
    {
        return PlanAck{failure.planID};
    }
    return EmptyAck{};
}

} // namespace ACS::Protocol::Detail
