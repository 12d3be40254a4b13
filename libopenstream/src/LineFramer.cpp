#include "LineFramer.hpp"

namespace ACS::OpenStream
{

namespace
{

constexpr char LINE_END = '\n';
constexpr std::string_view BLANKS = " \t\r";

bool IsBlank(std::string_view line)
{
    return line.find_first_not_of(BLANKS) == std::string_view::npos;
}

} // namespace

LineFramer::LineFramer(std::size_t maximumLine)
    : _maximumLine(maximumLine)
{
}

void LineFramer::Feed(std::string_view bytes)
{
    Keep();
    _input = bytes;
}

std::optional<std::string_view> LineFramer::TakeLineOrNull()
{
    while (true)
    {
        std::optional<std::string_view> line = TakeRawLineOrNull();
        if (!line.has_value())
        {
            return std::nullopt;
        }
        if (line->ends_with('\r'))
        {
            line->remove_suffix(1);
        }
        if (!IsBlank(*line))
        {
            return line;
        }
    }
}

std::optional<std::string_view> LineFramer::TakeRawLineOrNull()
{
    if (_bOverflown)
    {
        return std::nullopt;
    }
    if (_keptRead < _kept.size())
    {
        return CutKeptOrNull();
    }
    _kept.clear();
    _keptRead = 0;
    _scanned = 0;
    const std::size_t end = _input.find(LINE_END);
    if (end == std::string_view::npos)
    {
        KeepPartialLine();
        return std::nullopt;
    }
    const std::string_view line = _input.substr(0, end);
    _input.remove_prefix(end + 1);
    _bOverflown = line.size() > _maximumLine;
    if (_bOverflown)
    {
        return std::nullopt;
    }
    return line;
}

std::optional<std::string_view> LineFramer::CutKeptOrNull()
{
    std::size_t end = _kept.find(LINE_END, _scanned);
    if (end == std::string::npos)
    {
        // Only the input up to the end of this line: later lines need no copy.
        const std::size_t inputEnd = _input.find(LINE_END);
        if (inputEnd == std::string_view::npos)
        {
            KeepPartialLine();
            return std::nullopt;
        }
        _kept.erase(0, _keptRead);
        _keptRead = 0;
        _kept.append(_input.substr(0, inputEnd + 1));
        _input.remove_prefix(inputEnd + 1);
        end = _kept.size() - 1;
    }
    const std::string_view kept = _kept;
    const std::string_view line = kept.substr(_keptRead, end - _keptRead);
    _keptRead = end + 1;
    _scanned = _keptRead;
    _bOverflown = line.size() > _maximumLine;
    if (_bOverflown)
    {
        return std::nullopt;
    }
    return line;
}

void LineFramer::Keep()
{
    if (_bOverflown)
    {
        _input = {}; // discarded, so that nothing accumulates
    }
    if (_input.empty())
    {
        return;
    }
    _kept.erase(0, _keptRead);
    _scanned -= _keptRead;
    _keptRead = 0;
    _kept.append(_input);
    _input = {};
}

void LineFramer::KeepPartialLine()
{
    Keep();
    _scanned = _kept.size();
    _bOverflown = _kept.size() - _keptRead > _maximumLine;
}

bool LineFramer::HasOverflown() const noexcept
{
    return _bOverflown;
}

bool LineFramer::HasPartialLine() const noexcept
{
    return _keptRead < _kept.size() || !_input.empty();
}

void LineFramer::Reset()
{
    _kept.clear();
    _keptRead = 0;
    _scanned = 0;
    _input = {};
    _bOverflown = false;
}

} // namespace ACS::OpenStream
