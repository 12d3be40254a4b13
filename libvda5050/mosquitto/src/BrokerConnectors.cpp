#include "BrokerConnectors.hpp"

#include <algorithm>

namespace ACS::VDA5050
{

BrokerConnectors::BrokerConnectors(const boost::asio::any_io_executor& executor, std::size_t count)
{
    for (std::size_t index = 0; index < count; ++index)
    {
        _connectors.push_back(std::make_unique<MosquittoConnector>(executor));
    }
}

MosquittoConnector& BrokerConnectors::Get(std::size_t broker) const
{
    return *_connectors.at(broker);
}

bool BrokerConnectors::IsAnyBusy() const
{
    return std::ranges::any_of(_connectors, &MosquittoConnector::IsBusy);
}

std::optional<MosquittoClient> BrokerConnectors::TakeLateOrNull() const
{
    for (const std::unique_ptr<MosquittoConnector>& connector : _connectors)
    {
        if (std::optional<MosquittoClient> lateOrNull = connector->TakeLateOrNull(); lateOrNull.has_value())
        {
            return lateOrNull;
        }
    }
    return std::nullopt;
}

void BrokerConnectors::Abandon() const noexcept
{
    for (const std::unique_ptr<MosquittoConnector>& connector : _connectors)
    {
        connector->Abandon();
    }
}

} // namespace ACS::VDA5050
