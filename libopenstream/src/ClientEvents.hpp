#pragma once

#include <acs/openstream/ClientSessionActions.hpp>

#include <utility>

namespace ACS::OpenStream::Detail
{

/// Appends an event for the owner.
template <typename TEvent>
void Report(TEvent event, ClientActions& out)
{
    out.emplace_back(ClientEvent(std::move(event)));
}

} // namespace ACS::OpenStream::Detail
