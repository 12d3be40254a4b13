#include "StoreWorker.hpp"

#include <boost/asio/post.hpp>
#include <boost/asio/thread_pool.hpp>

#include <utility>

namespace ACS::Acsd
{

struct StoreWorker::Impl
{
    boost::asio::any_io_executor executor;
    std::unique_ptr<Planning::IPlanStore> store;
    StoredHandler handler;
    boost::asio::thread_pool thread{1};
};

StoreWorker::StoreWorker(
    const boost::asio::any_io_executor& executor,
    std::unique_ptr<Planning::IPlanStore> store,
    StoredHandler handler)
    : _impl(std::make_shared<Impl>())
{
    _impl->executor = executor;
    _impl->store = std::move(store);
    _impl->handler = std::move(handler);
}

StoreWorker::~StoreWorker()
{
    _impl->handler = nullptr;
    _impl->thread.join();
}

void StoreWorker::Append(const Planning::StoreBatch& batch)
{
    // The store outlives the thread's work: the destructor waits for it.
    boost::asio::post(_impl->thread, [weak = std::weak_ptr(_impl), &store = *_impl->store, batch]() {
        Core::Result<void> result = store.Append(batch);
        const std::shared_ptr<Impl> self = weak.lock();
        if (self == nullptr)
        {
            return;
        }
        boost::asio::post(self->executor, [weak, result = std::move(result)]() {
            const std::shared_ptr<Impl> owner = weak.lock();
            if (owner != nullptr && owner->handler)
            {
                owner->handler(result);
            }
        });
    });
}

} // namespace ACS::Acsd
