#include "events/SseParser.hpp"

#include <utility>

namespace ACS::Acsctl
{

bool SseParser::TryRead(std::string_view part, std::vector<SseEvent>& out)
{
    for (const char letter : part)
    {
        if (letter == '\n' && _bAfterReturn)
        {
            _bAfterReturn = false;
            continue;
        }
        _bAfterReturn = letter == '\r';
        if (letter == '\r' || letter == '\n')
        {
            EndLine(out);
        }
        else
        {
            _line += letter;
        }
        if (_line.size() + _data.size() > MAX_BYTES)
        {
            return false;
        }
    }
    return true;
}

void SseParser::EndLine(std::vector<SseEvent>& out)
{
    constexpr std::string_view BYTE_ORDER_MARK = "\xEF\xBB\xBF";
    std::string line = std::exchange(_line, {});
    if (std::exchange(_bAtStart, false) && line.starts_with(BYTE_ORDER_MARK))
    {
        line.erase(0, BYTE_ORDER_MARK.size());
    }
    if (line.empty())
    {
        std::string type = std::exchange(_type, {});
        std::string data = std::exchange(_data, {});
        if (std::exchange(_bHasData, false))
        {
            out.push_back({type.empty() ? "message" : std::move(type), _id, std::move(data)});
        }
        return;
    }
    const std::size_t colon = line.find(':');
    if (colon == std::string::npos)
    {
        ReadField(line, {});
        return;
    }
    std::string_view value = std::string_view(line).substr(colon + 1);
    if (value.starts_with(' '))
    {
        value.remove_prefix(1);
    }
    ReadField(std::string_view(line).substr(0, colon), value); // an empty name: a comment
}

void SseParser::ReadField(std::string_view name, std::string_view value)
{
    if (name == "data")
    {
        _data.append(_bHasData ? "\n" : "").append(value);
        _bHasData = true;
    }
    else if (name == "event")
    {
        _type = value;
    }
    else if (name == "id" && value.find('\0') == std::string_view::npos)
    {
        _id = value;
    }
}

} // namespace ACS::Acsctl
