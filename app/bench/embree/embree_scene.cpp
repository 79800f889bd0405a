// SPDX-License-Identifier: MIT
#include "app/bench/embree_scene.h"

#include "renderer/base/error.h"
#include "renderer/gl/runtime_library.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <barrier>
#include <chrono>
#include <functional>
#include <new>
#include <thread>

#include <embree3/rtcore.h>

namespace afterglow {

namespace {

constexpr std::size_t kChunk = 1024; ///< rays that a thread takes at a time

/// Threads that stay for the next job: a list of few rays is traced faster than a thread begins.
class Threads {
public:
    explicit Threads(unsigned count) : begin_(count), end_(count) {
        for (unsigned i = 1; i < count; ++i)
            others_.emplace_back([this] {
                for (;;) {
                    begin_.arrive_and_wait();
                    if (!job_)
                        return;
                    job_();
                    end_.arrive_and_wait();
                }
            });
    }
    ~Threads() {
        job_ = nullptr;
        begin_.arrive_and_wait();
    }
    Threads(const Threads&) = delete;
    Threads& operator=(const Threads&) = delete;

    /// Runs a job, which throws nothing, once on each thread, of which the caller's is one.
    void run(std::function<void()> job) {
        job_ = std::move(job);
        begin_.arrive_and_wait();
        job_();
        end_.arrive_and_wait();
    }

private:
    std::barrier<> begin_, end_;
    std::function<void()> job_;
    std::vector<std::jthread> others_; // joined first: they use the others
};

/// The functions of Embree that are used. It is opened when it is first asked for: no other command
/// pays for it, and the program runs on machines without it.
struct Embree {
    RuntimeLibrary library{"libembree3.so.3"};
    decltype(::rtcAttachGeometry)* attachGeometry =
        function<decltype(::rtcAttachGeometry)>("rtcAttachGeometry");
    decltype(::rtcBuildBVH)* buildBvh = function<decltype(::rtcBuildBVH)>("rtcBuildBVH");
    decltype(::rtcCommitGeometry)* commitGeometry =
        function<decltype(::rtcCommitGeometry)>("rtcCommitGeometry");
    decltype(::rtcCommitScene)* commitScene =
        function<decltype(::rtcCommitScene)>("rtcCommitScene");
    decltype(::rtcGetDeviceError)* getDeviceError =
        function<decltype(::rtcGetDeviceError)>("rtcGetDeviceError");
    decltype(::rtcIntersect1)* intersect1 = function<decltype(::rtcIntersect1)>("rtcIntersect1");
    decltype(::rtcNewBVH)* newBvh = function<decltype(::rtcNewBVH)>("rtcNewBVH");
    decltype(::rtcNewDevice)* newDevice = function<decltype(::rtcNewDevice)>("rtcNewDevice");
    decltype(::rtcNewGeometry)* newGeometry =
        function<decltype(::rtcNewGeometry)>("rtcNewGeometry");
    decltype(::rtcNewScene)* newScene = function<decltype(::rtcNewScene)>("rtcNewScene");
    decltype(::rtcOccluded1)* occluded1 = function<decltype(::rtcOccluded1)>("rtcOccluded1");
    decltype(::rtcReleaseBVH)* releaseBvh = function<decltype(::rtcReleaseBVH)>("rtcReleaseBVH");
    decltype(::rtcReleaseDevice)* releaseDevice =
        function<decltype(::rtcReleaseDevice)>("rtcReleaseDevice");
    decltype(::rtcReleaseGeometry)* releaseGeometry =
        function<decltype(::rtcReleaseGeometry)>("rtcReleaseGeometry");
    decltype(::rtcReleaseScene)* releaseScene =
        function<decltype(::rtcReleaseScene)>("rtcReleaseScene");
    decltype(::rtcSetGeometryBuildQuality)* setGeometryBuildQuality =
        function<decltype(::rtcSetGeometryBuildQuality)>("rtcSetGeometryBuildQuality");
    decltype(::rtcSetNewGeometryBuffer)* setNewGeometryBuffer =
        function<decltype(::rtcSetNewGeometryBuffer)>("rtcSetNewGeometryBuffer");
    decltype(::rtcSetSceneBuildQuality)* setSceneBuildQuality =
        function<decltype(::rtcSetSceneBuildQuality)>("rtcSetSceneBuildQuality");
    decltype(::rtcThreadLocalAlloc)* threadLocalAlloc =
        function<decltype(::rtcThreadLocalAlloc)>("rtcThreadLocalAlloc");

    template <class Function>
    Function* function(const char* name) const {
        return library.function<Function>(name);
    }
};

const Embree& embree() {
    static const Embree functions;
    return functions;
}

RTCDevice newDevice(unsigned threads) {
    const RTCDevice device = embree().newDevice(("threads=" + std::to_string(threads)).c_str());
    if (!device)
        throw Error("Embree makes no device: error " +
                    std::to_string(embree().getDeviceError(nullptr)));
    return device;
}

RTCRay rayOf(const ListedRay& ray) {
    return {.org_x = ray.origin.x,
            .org_y = ray.origin.y,
            .org_z = ray.origin.z,
            .tnear = 0.0f,
            .dir_x = ray.direction.x,
            .dir_y = ray.direction.y,
            .dir_z = ray.direction.z,
            .time = 0.0f,
            .tfar = ray.tMax,
            .mask = ~0u,
            .id = 0,
            .flags = 0};
}

bool isOccluded(const Embree& embree, RTCScene scene, RTCIntersectContext& context,
                const ListedRay& listed) {
    RTCRay ray = rayOf(listed);
    embree.occluded1(scene, &context, &ray);
    return ray.tfar < 0.0f;
}

bool isHit(const Embree& embree, RTCScene scene, RTCIntersectContext& context,
           const ListedRay& listed) {
    RTCRayHit query{};
    query.ray = rayOf(listed);
    query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    embree.intersect1(scene, &context, &query);
    return query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
}

/// A node of the tree that Embree's builder makes, or a leaf.
struct TreeNode {
    std::array<Aabb, gpu::kBvhWidth> boxes;
    std::array<const TreeNode*, gpu::kBvhWidth> children{};
    std::size_t triangles = 0; ///< of a leaf
};

Aabb boxOf(const RTCBounds& bounds) {
    return {.min = {bounds.lower_x, bounds.lower_y, bounds.lower_z},
            .max = {bounds.upper_x, bounds.upper_y, bounds.upper_z}};
}

double areaOf(const Aabb& box) {
    const glm::dvec3 e(box.max - box.min);
    return e.x * e.y + e.y * e.z + e.z * e.x;
}

// The rule of afterglow::sahCost(): each record costs its box's area, and a triangle is a record.
double costBelow(const TreeNode& node) {
    double cost = 0.0;
    for (std::size_t k = 0; k < node.children.size(); ++k)
        if (const TreeNode* const child = node.children[k])
            cost += child->triangles > 0 ? areaOf(node.boxes[k]) * double(child->triangles)
                                         : areaOf(node.boxes[k]) + costBelow(*child);
    return cost;
}

TreeNode* newNode(RTCThreadLocalAllocator allocator) {
    void* const place = embree().threadLocalAlloc(allocator, sizeof(TreeNode), alignof(TreeNode));
    return new (place) TreeNode;
}

void* makeNode(RTCThreadLocalAllocator allocator, unsigned, void*) {
    return newNode(allocator);
}
void setChildren(void* node, void** children, unsigned count, void*) {
    for (unsigned k = 0; k < count; ++k)
        static_cast<TreeNode*>(node)->children[k] = static_cast<const TreeNode*>(children[k]);
}
void setBounds(void* node, const RTCBounds** bounds, unsigned count, void*) {
    for (unsigned k = 0; k < count; ++k)
        static_cast<TreeNode*>(node)->boxes[k] = boxOf(*bounds[k]);
}
void* makeLeaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive*, std::size_t count,
               void*) {
    TreeNode* const leaf = newNode(allocator);
    leaf->triangles = count;
    return leaf;
}

} // namespace

struct EmbreeScene::Impl {
    explicit Impl(unsigned count)
        : workers(count), device(newDevice(count)), scene(embree().newScene(device)) {}
    ~Impl() {
        embree().releaseScene(scene);
        embree().releaseDevice(device);
    }
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    Threads workers;
    RTCDevice device;
    RTCScene scene;
    double milliseconds = 0.0;
};

bool EmbreeScene::isThere() {
    try {
        embree();
        return true;
    } catch (const ContextError&) {
        return false;
    }
}

EmbreeScene::EmbreeScene(std::span<const gpu::BvhTriangle> triangles, unsigned threads)
    : impl_(std::make_unique<Impl>(threads)) {
    const RTCGeometry geometry = embree().newGeometry(impl_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<glm::vec3*>(
        embree().setNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                      sizeof(glm::vec3), 3 * triangles.size()));
    auto* indices = static_cast<glm::uvec3*>(
        embree().setNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                      sizeof(glm::uvec3), triangles.size()));
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        vertices[3 * i] = triangles[i].v0;
        vertices[3 * i + 1] = triangles[i].v1;
        vertices[3 * i + 2] = triangles[i].v2;
        indices[i] = glm::uvec3(3 * i, 3 * i + 1, 3 * i + 2);
    }
    embree().setGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_MEDIUM);
    embree().commitGeometry(geometry);
    embree().attachGeometry(impl_->scene, geometry);
    embree().releaseGeometry(geometry);
    embree().setSceneBuildQuality(impl_->scene, RTC_BUILD_QUALITY_MEDIUM);
    const auto start = std::chrono::steady_clock::now();
    embree().commitScene(impl_->scene);
    impl_->milliseconds =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

EmbreeScene::~EmbreeScene() = default;

double EmbreeScene::buildMilliseconds() const {
    return impl_->milliseconds;
}

void EmbreeScene::trace(std::span<const ListedRay> rays, bool anyHit,
                        std::span<std::uint8_t> hits) const {
    const Embree& functions = embree();
    std::atomic<std::size_t> next{0};
    impl_->workers.run([&] {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        for (std::size_t i = next.fetch_add(kChunk); i < rays.size(); i = next.fetch_add(kChunk))
            for (std::size_t k = i; k < std::min(i + kChunk, rays.size()); ++k)
                hits[k] = anyHit ? isOccluded(functions, impl_->scene, context, rays[k])
                                 : isHit(functions, impl_->scene, context, rays[k]);
    });
}

double EmbreeScene::sahCost(std::span<const Aabb> boxes, unsigned threads) {
    if (boxes.empty())
        return 1.0;
    std::vector<RTCBuildPrimitive> primitives(boxes.size());
    Aabb all;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        all.include(boxes[i]);
        primitives[i] = {.lower_x = boxes[i].min.x,
                         .lower_y = boxes[i].min.y,
                         .lower_z = boxes[i].min.z,
                         .geomID = 0,
                         .upper_x = boxes[i].max.x,
                         .upper_y = boxes[i].max.y,
                         .upper_z = boxes[i].max.z,
                         .primID = unsigned(i)};
    }
    const RTCDevice device = newDevice(threads);
    const RTCBVH bvh = embree().newBvh(device);
    RTCBuildArguments build = rtcDefaultBuildArguments();
    build.buildQuality = RTC_BUILD_QUALITY_MEDIUM;
    build.maxBranchingFactor = gpu::kBvhWidth;
    build.maxLeafSize = kBvhMaxLeafSize;
    build.bvh = bvh;
    build.primitives = primitives.data();
    build.primitiveCount = primitives.size();
    build.primitiveArrayCapacity = primitives.size();
    build.createNode = makeNode;
    build.setNodeChildren = setChildren;
    build.setNodeBounds = setBounds;
    build.createLeaf = makeLeaf;
    const auto* const root = static_cast<const TreeNode*>(embree().buildBvh(&build));
    double cost = 1.0;
    if (root && root->triangles > 0) // a node above the only leaf, as ours has it
        cost += double(root->triangles);
    else if (root && areaOf(all) > 0.0)
        cost += costBelow(*root) / areaOf(all);
    embree().releaseBvh(bvh);
    embree().releaseDevice(device);
    return cost;
}

} // namespace afterglow
