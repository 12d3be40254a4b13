#include "trace/TraceMerge.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace ACS::Acsctl
{

TraceMerge::TraceMerge(std::vector<TraceSource> sources)
    : _waiting(std::move(sources))
{
}

Outcome<const std::string*> TraceMerge::ReadNextOrNull()
{
    for (TraceSource& source : std::exchange(_waiting, {}))
    {
        const Outcome<bool> read = source.ReadNext();
        if (!read.has_value())
        {
            return tl::make_unexpected(read.error());
        }
        if (*read)
        {
            _ready.push_back(std::move(source));
        }
    }
    if (_given.has_value())
    {
        const auto given = _ready.begin() + static_cast<std::ptrdiff_t>(*std::exchange(_given, std::nullopt));
        const Outcome<bool> read = given->ReadNext();
        if (!read.has_value())
        {
            return tl::make_unexpected(read.error());
        }
        if (!*read)
        {
            _ready.erase(given);
        }
    }
    const auto first = std::ranges::min_element(_ready, {}, &TraceSource::GetKey);
    if (first == _ready.end())
    {
        return nullptr;
    }
    _given = static_cast<std::size_t>(std::distance(_ready.begin(), first));
    return &first->GetLine();
}

} // namespace ACS::Acsctl
