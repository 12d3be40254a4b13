#include "console/RunOutput.hpp"

#include <fmt/format.h>

#include <chrono>
#include <utility>

namespace ACS::McsSim
{

namespace
{

/// Tables are written once: a terminal may wrap a long reason, cut off it would be of no use.
constexpr std::size_t MAX_TABLE_COLUMNS = 1000;

} // namespace

RunOutput::RunOutput(
    const Core::IClock& clock,
    std::ostream& out,
    Screen* screenOrNull,
    std::size_t columns,
    std::size_t rows)
    : _clock(clock),
      _out(out),
      _screenOrNull(screenOrNull),
      _view(columns, rows),
      _started(clock.GetNow().steady)
{
}

void RunOutput::Begin() noexcept
{
    _bBegun = true;
}

PlanTracker::Lines& RunOutput::GetLines() noexcept
{
    return _lines;
}

void RunOutput::SetAddress(std::string address)
{
    _heading.address = std::move(address);
}

void RunOutput::SetRegistered(bool bRegistered) noexcept
{
    _heading.bRegistered = bRegistered;
}

void RunOutput::SetKept() noexcept
{
    _heading.bKept = true;
}

void RunOutput::SetFinished() noexcept
{
    _finished = _clock.GetNow().steady;
}

Core::SteadyTime RunOutput::GetEnd() const
{
    return _finished.value_or(_clock.GetNow().steady);
}

bool RunOutput::IsFinished() const noexcept
{
    return _finished.has_value();
}

void RunOutput::Flush()
{
    if (_screenOrNull == nullptr && !_lines.empty())
    {
        const std::chrono::duration<double> elapsed = _clock.GetNow().steady - _started;
        for (const std::string& line : _lines)
        {
            _out << fmt::format("{:.3f} {}\n", elapsed.count(), line);
        }
        _out << std::flush;
    }
    _lines.clear();
}

void RunOutput::Draw(const PlanTracker& tracker, const RobotBoard& board)
{
    if (_screenOrNull != nullptr && _bBegun)
    {
        _heading.elapsed = std::chrono::duration_cast<std::chrono::milliseconds>(GetEnd() - _started);
        _screenOrNull->Draw(_view.Render(tracker, board, _heading));
    }
}

void RunOutput::Leave()
{
    if (_screenOrNull != nullptr)
    {
        _screenOrNull->Leave();
    }
}

void RunOutput::PrintTable(const StyledLines& lines)
{
    for (const StyledLine& line : lines)
    {
        _out << MakeText(line, MAX_TABLE_COLUMNS, _screenOrNull != nullptr) << '\n';
    }
}

void RunOutput::PrintLine(const std::string& line)
{
    _out << line << std::endl;
}

} // namespace ACS::McsSim
