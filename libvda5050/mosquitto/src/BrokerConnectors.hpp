#pragma once

#include "MosquittoConnector.hpp"

#include <boost/asio/any_io_executor.hpp>

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace ACS::VDA5050
{

/// A connector for each broker: a name server that does not answer for one delays no other. Used on the executor's thread.
class BrokerConnectors final
{
    std::vector<std::unique_ptr<MosquittoConnector>> _connectors;

public:
    BrokerConnectors(const boost::asio::any_io_executor& executor, std::size_t count);

    [[nodiscard]] MosquittoConnector& Get(std::size_t broker) const;
    [[nodiscard]] bool IsAnyBusy() const;

    /// Of any broker; as MosquittoConnector::TakeLateOrNull.
    [[nodiscard]] std::optional<MosquittoClient> TakeLateOrNull() const;

    void Abandon() const noexcept;
};

} // namespace ACS::VDA5050
