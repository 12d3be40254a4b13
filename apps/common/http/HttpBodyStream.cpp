#include "common/http/HttpBodyStream.hpp"

#include <utility>

namespace ACS::Apps
{

HttpBodyStream::HttpBodyStream(Source takeNext)
    : _takeNext(std::move(takeNext))
{
}

void HttpBodyStream::Notify()
{
    if (_bOpen && _onChange)
    {
        _onChange();
    }
}

void HttpBodyStream::End()
{
    _bOpen = false;
    if (const Handler onChange = std::exchange(_onChange, nullptr); onChange)
    {
        onChange();
    }
}

bool HttpBodyStream::IsOpen() const noexcept
{
    return _bOpen;
}

void HttpBodyStream::Attach(Handler onChange)
{
    _onChange = std::move(onChange);
}

std::string HttpBodyStream::TakeNext() const
{
    return _bOpen ? _takeNext() : std::string();
}

} // namespace ACS::Apps
