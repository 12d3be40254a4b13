#include "mcs/McsNoteLog.hpp"

#include "mcs/McsGateway.hpp"

#include <fmt/format.h>

#include <utility>

namespace ACS::Acsd
{

namespace
{

/// Deviations that have no effect.
bool IsHarmless(Protocol::EProtocolNote what)
{
    switch (what)
    {
        case Protocol::EProtocolNote::UnknownMember:
        case Protocol::EProtocolNote::NullOptional:
        case Protocol::EProtocolNote::LenientWord:
        case Protocol::EProtocolNote::LenientNumber:
        case Protocol::EProtocolNote::BadTimestamp:
        case Protocol::EProtocolNote::DuplicateRequest:
            return true;
        case Protocol::EProtocolNote::Undecodable:
        case Protocol::EProtocolNote::UnknownCommand:
        case Protocol::EProtocolNote::AckMismatched:
        case Protocol::EProtocolNote::AckUnexpected:
        case Protocol::EProtocolNote::AckFailed:
        case Protocol::EProtocolNote::BeforeRegistered:
        case Protocol::EProtocolNote::RegistrationUnanswered:
        default:
            return false;
    }
}

} // namespace

McsNoteLog::McsNoteLog(Core::Logger logger)
    : _log(std::move(logger))
{
}

void McsNoteLog::OnNoted(const Protocol::ProtocolNoted& noted, std::uint64_t total, Core::SteadyTime now)
{
    Flush(now);
    const bool bMayBeRefused =
        noted.what == Protocol::EProtocolNote::Undecodable || noted.what == Protocol::EProtocolNote::UnknownCommand;
    if (bMayBeRefused)
    {
        _waiting = Waiting{noted, total};
    }
    else
    {
        Write({noted, total}, now);
    }
}

void McsNoteLog::Drop()
{
    _waiting.reset();
}

void McsNoteLog::Flush(Core::SteadyTime now)
{
    if (const std::optional<Waiting> note = std::exchange(_waiting, std::nullopt))
    {
        Write(*note, now);
    }
}

void McsNoteLog::Write(const Waiting& note, Core::SteadyTime now)
{
    const std::string_view what = GetText(note.noted.what);
    _log.Write(
        now,
        IsHarmless(note.noted.what) ? Core::ELogLevel::Debug : Core::ELogLevel::Warning,
        fmt::format("{} {}", what, CutReason(note.noted.detail)),
        "the MCS deviates from the protocol",
        {{"what", what}, {"detail", note.noted.detail}, {"count", fmt::format_int(note.total).str()}});
}

} // namespace ACS::Acsd
