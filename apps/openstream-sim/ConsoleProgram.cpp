#include "ConsoleProgram.hpp"

namespace ACS::OpenStreamSim
{

namespace
{

constexpr std::size_t MOST_STATEMENTS = 1'000;
constexpr std::string_view WAIT = "wait ";
constexpr std::string_view END = "end";

} // namespace

bool ConsoleProgram::TryAdd(std::string_view text)
{
    if (_statements.size() >= MOST_STATEMENTS || IsRunning())
    {
        return false;
    }
    if (text == END)
    {
        _statements.emplace_back(EndStatement{});
        return true;
    }
    if (text.starts_with(WAIT))
    {
        const std::optional<RelayName> relay = ParseRelayNameOrNull(text.substr(WAIT.size()));
        if (relay.has_value())
        {
            _statements.emplace_back(WaitStatement{*relay});
        }
        return relay.has_value();
    }
    const std::optional<MoveStatement> move = ParseMoveOrNull(text);
    if (move.has_value())
    {
        _statements.emplace_back(*move);
    }
    return move.has_value();
}

void ConsoleProgram::Clear()
{
    Reset();
    _statements.clear();
}

void ConsoleProgram::Start()
{
    _phase = EPhase::Running;
}

void ConsoleProgram::Stop()
{
    if (_phase == EPhase::Running)
    {
        _phase = EPhase::Halted;
        _bMoving = false;
    }
}

void ConsoleProgram::Reset()
{
    _phase = EPhase::AtBeginning;
    _next = 0;
    _bMoving = false;
}

bool ConsoleProgram::TryReleaseWait()
{
    const bool bWaiting = IsWaiting();
    _next += bWaiting ? 1U : 0U;
    return bWaiting;
}

void ConsoleProgram::Advance(Core::Duration from, Core::Duration until, Arm& arm, const RelayMemory& relays)
{
    Core::Duration now = from;
    while (_phase == EPhase::Running)
    {
        if (_next >= _statements.size() || std::holds_alternative<EndStatement>(_statements[_next]))
        {
            arm.Stop(now);
            Reset();
            return;
        }
        const auto* const waitOrNull = std::get_if<WaitStatement>(&_statements[_next]);
        if (waitOrNull != nullptr)
        {
            if (relays.Read(waitOrNull->relay) == 0.0)
            {
                return;
            }
            ++_next;
            continue;
        }
        const MoveStatement& move = *std::get_if<MoveStatement>(&_statements[_next]);
        if (!_bMoving)
        {
            arm.Stop(now);
            arm.BeginMove(move.target, ComputeMoveSeconds(move, arm.GetStates(now, {}).position), now);
            _bMoving = true;
        }
        if (arm.GetMoveEnd() > until)
        {
            return;
        }
        now = arm.GetMoveEnd();
        _bMoving = false;
        ++_next;
    }
}

bool ConsoleProgram::IsEmpty() const noexcept
{
    return _statements.empty();
}

bool ConsoleProgram::IsRunning() const noexcept
{
    return _phase == EPhase::Running;
}

bool ConsoleProgram::IsHalted() const noexcept
{
    return _phase == EPhase::Halted;
}

bool ConsoleProgram::IsWaiting() const noexcept
{
    return IsRunning() && _next < _statements.size() && std::holds_alternative<WaitStatement>(_statements[_next]);
}

} // namespace ACS::OpenStreamSim
