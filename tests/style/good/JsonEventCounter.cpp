#include "JsonEventCounter.hpp"

#include <algorithm>
#include <vector>

namespace ACS::Sample
{

namespace
{

/// Predicates and pointers in lambdas have no name that could be wrong.
bool HasZero(const std::vector<int>& values)
{
    const auto isZero = [](int value) {
        return value == 0;
    };
    return std::ranges::any_of(values, isZero);
}

} // namespace

JsonEventCounter::JsonEventCounter(std::chrono::milliseconds limit)
    : _limit(limit)
{
}

bool JsonEventCounter::Null()
{
    return TryCount();
}

bool JsonEventCounter::Bool(bool /*bValue*/)
{
    return TryCount();
}

bool JsonEventCounter::Int(int /*value*/)
{
    return TryCount();
}

bool JsonEventCounter::Uint(unsigned /*value*/)
{
    return TryCount();
}

bool JsonEventCounter::Int64(std::int64_t /*value*/)
{
    return TryCount();
}

bool JsonEventCounter::Uint64(std::uint64_t /*value*/)
{
    return TryCount();
}

bool JsonEventCounter::Double(double /*value*/)
{
    return TryCount();
}

bool JsonEventCounter::RawNumber(const char* /*text*/, std::size_t /*length*/, bool /*bCopy*/)
{
    return TryCount();
}

bool JsonEventCounter::String(const char* /*text*/, std::size_t /*length*/, bool /*bCopy*/)
{
    return TryCount();
}

bool JsonEventCounter::StartObject()
{
    return TryCount();
}

bool JsonEventCounter::Key(const char* /*text*/, std::size_t /*length*/, bool /*bCopy*/)
{
    return TryCount();
}

bool JsonEventCounter::EndObject(std::size_t /*memberCount*/)
{
    return TryCount();
}

bool JsonEventCounter::StartArray()
{
    return TryCount();
}

bool JsonEventCounter::EndArray(std::size_t /*elementCount*/)
{
    return TryCount();
}

bool JsonEventCounter::IsLongerThan(std::chrono::milliseconds duration) const noexcept
{
    return _limit > duration;
}

bool JsonEventCounter::TryCount()
{
    const std::vector<int> divisors{1, 2};
    if (_bStopping || HasZero(divisors))
    {
        return false;
    }
    ++_count;
    return true;
}

} // namespace ACS::Sample
