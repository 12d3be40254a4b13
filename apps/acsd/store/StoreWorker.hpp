#pragma once

#include "store/ResourceThread.hpp"
#include <acs/core/Result.hpp>
#include <acs/plan/IPlanStore.hpp>
#include <acs/plan/StoreLog.hpp>

#include <boost/asio/any_io_executor.hpp>

#include <functional>
#include <memory>

namespace ACS::Acsd
{

/// Runs the store in its own thread, so that acsd handles inputs while the disk writes. Called and answered on the thread of
/// the executor.
class StoreWorker final
{
public:
    using StoredHandler = std::function<void(const Core::Result<void>& result)>;
    using CheckedHandler = std::function<void(const Core::Result<Planning::StoreLog>& result)>;

private:
    StoredHandler _handler;
    CheckedHandler _checkedHandler;
    bool _bChecking = false;
    ResourceThread<Planning::IPlanStore> _store;

public:
    /// The second handler is called after each check. The worker waits in its destructor until all batches that were appended are
    /// written, and calls no handler any more.
    StoreWorker(
        const boost::asio::any_io_executor& executor,
        std::unique_ptr<Planning::IPlanStore> store,
        StoredHandler handler,
        CheckedHandler checkedHandler);

    /// Batches are written one after the other. Each is answered by one call of the handler, never from within this call.
    void Append(const Planning::StoreBatch& batch);

    /// Checks whether a restart would find the stored data, and then the log of the store. Does nothing while the previous check
    /// is not answered.
    void CheckAsync();
};

} // namespace ACS::Acsd
