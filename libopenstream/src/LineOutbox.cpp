#include "LineOutbox.hpp"

#include <cassert>
#include <utility>

namespace ACS::OpenStream
{

LineOutbox::LineOutbox(std::size_t maximumBytes)
    : _maximumBytes(maximumBytes)
{
}

std::string& LineOutbox::GetLines() noexcept
{
    return _lines;
}

std::string& LineOutbox::BeginData(bool& bReplacedOut)
{
    bReplacedOut = !_data.empty();
    _data.clear();
    return _data;
}

void LineOutbox::SealData()
{
    if (!_data.empty())
    {
        _lines += _data;
        ++_dataLines;
        _data.clear();
    }
}

std::string_view LineOutbox::TakeForSend()
{
    if (_bSending || IsEmpty())
    {
        return {};
    }
    _sendingBytes = _lines.size();
    _dataLinesSending = _dataLines + (_data.empty() ? 0U : 1U);
    _dataLines = 0;
    _sending.clear();
    if (_lines.empty())
    {
        _sending.swap(_data);
    }
    else
    {
        _sending.swap(_lines);
        _sending += _data;
        _data.clear();
    }
    _bSending = true;
    return _sending;
}

std::size_t LineOutbox::CompleteSend()
{
    assert(_bSending);
    _bSending = false;
    _sentBytes += _sendingBytes;
    _sendingBytes = 0;
    return std::exchange(_dataLinesSending, 0U);
}

bool LineOutbox::IsEmpty() const noexcept
{
    return _lines.empty() && _data.empty();
}

bool LineOutbox::IsSending() const noexcept
{
    return _bSending;
}

bool LineOutbox::IsFull() const noexcept
{
    return _lines.size() > _maximumBytes;
}

std::uint64_t LineOutbox::GetMark() const noexcept
{
    return _sentBytes + _sendingBytes + _lines.size();
}

bool LineOutbox::WasTaken(std::uint64_t mark) const noexcept
{
    return _sentBytes + _sendingBytes >= mark;
}

bool LineOutbox::WasSent(std::uint64_t mark) const noexcept
{
    return _sentBytes >= mark;
}

void LineOutbox::Reset()
{
    _lines.clear();
    _data.clear();
    _sending.clear();
    _sentBytes = 0;
    _sendingBytes = 0;
    _dataLines = 0;
    _dataLinesSending = 0;
    _bSending = false;
}

} // namespace ACS::OpenStream
