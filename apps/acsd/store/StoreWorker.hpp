#pragma once

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
    struct Impl;

    std::shared_ptr<Impl> _impl;

public:
    /// The second handler is called after each check.
    StoreWorker(
        const boost::asio::any_io_executor& executor,
        std::unique_ptr<Planning::IPlanStore> store,
        StoredHandler handler,
        CheckedHandler checkedHandler);
    StoreWorker(const StoreWorker&) = delete;
    StoreWorker& operator=(const StoreWorker&) = delete;

    /// Waits until all batches that were appended are written. Calls no handler any more.
    ~StoreWorker();

    /// Batches are written one after the other. Each is answered by one call of the handler, never from within this call.
    void Append(const Planning::StoreBatch& batch);

    /// Checks whether a restart would find the stored data, and then the log of the store. Does nothing while the previous check
    /// is not answered.
    void CheckAsync();

private:
    template <typename TWork, typename TAnswer>
    void Do(TWork work, TAnswer answer);
};

} // namespace ACS::Acsd
