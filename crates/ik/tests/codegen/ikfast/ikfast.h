/* A replacement for the header of IKFast's callers, for tests: the classes and functions of its documented interface, written independently.
 *
 * https://docs.ros.org/en/ros2_packages/iron/api/moveit_resources_prbt_ikfast_manipulator_plugin/generated/ lists MoveIt's header; with
 * IKFAST_DOUBLE_OPENRAVE the declarations are those of OpenRAVE's later one. */
#ifndef GROEBOT_IKFAST_DOUBLE
#define GROEBOT_IKFAST_DOUBLE

#include <stdexcept>
#include <vector>

namespace ikfast {

template <typename T>
struct IkSingleDOFSolutionBase {
    T fmul, foffset;
    signed char freeind;
    unsigned char jointtype, maxsolutions;
    unsigned char indices[5];

    IkSingleDOFSolutionBase() : fmul(0), foffset(0), freeind(-1), jointtype(1), maxsolutions(1)
    {
        for (unsigned char &index : indices) {
            index = 255;
        }
    }
};

template <typename T>
class IkSolutionBase {
public:
    virtual ~IkSolutionBase() {}
    virtual void GetSolution(T *solution, const T *freevalues) const = 0;
    virtual const std::vector<int> &GetFree() const = 0;
    virtual int GetDOF() const = 0;
};

template <typename T>
class IkSolutionListBase {
public:
    virtual ~IkSolutionListBase() {}
    virtual std::size_t AddSolution(const std::vector<IkSingleDOFSolutionBase<T> > &joints, const std::vector<int> &free) = 0;
    virtual const IkSolutionBase<T> &GetSolution(std::size_t index) const = 0;
    virtual std::size_t GetNumSolutions() const = 0;
    virtual void Clear() = 0;
};

/* A solution with the check of the original Validate function. */
template <typename T>
class IkSolution : public IkSolutionBase<T> {
public:
    IkSolution(const std::vector<IkSingleDOFSolutionBase<T> > &joints, const std::vector<int> &free) : joints_(joints), free_(free)
    {
        for (const IkSingleDOFSolutionBase<T> &joint : joints_) {
            const bool counted = joint.maxsolutions == 0 || joint.indices[0] < joint.maxsolutions;
            const bool known = joint.jointtype == 0x01 || joint.jointtype == 0x11;
            if (joint.maxsolutions == 255 || !counted || !known || joint.freeind >= 0) {
                throw std::runtime_error("malformed solution");
            }
        }
    }

    void GetSolution(T *solution, const T *) const override
    {
        for (const IkSingleDOFSolutionBase<T> &joint : joints_) {
            *solution++ = joint.foffset;
        }
    }

    const std::vector<int> &GetFree() const override
    {
        return free_;
    }

    int GetDOF() const override
    {
        return static_cast<int>(joints_.size());
    }

    /* The indices as one number, the first joint's being the lowest digit. */
    unsigned long long Branch() const
    {
        unsigned long long number = 0;
        for (std::size_t i = joints_.size(); i-- > 0;) {
            if (joints_[i].maxsolutions > 1) {
                number = number * joints_[i].maxsolutions + joints_[i].indices[0];
            }
        }
        return number;
    }

private:
    std::vector<IkSingleDOFSolutionBase<T> > joints_;
    std::vector<int> free_;
};

template <typename T>
class IkSolutionList : public IkSolutionListBase<T> {
public:
    std::size_t AddSolution(const std::vector<IkSingleDOFSolutionBase<T> > &joints, const std::vector<int> &free) override
    {
        list_.push_back(IkSolution<T>(joints, free));
        return list_.size() - 1;
    }

    const IkSolution<T> &GetSolution(std::size_t index) const override
    {
        return list_.at(index);
    }

    std::size_t GetNumSolutions() const override
    {
        return list_.size();
    }

    void Clear() override
    {
        list_.clear();
    }

private:
    std::vector<IkSolution<T> > list_;
};

} // namespace ikfast

#endif

#ifdef IKFAST_HAS_LIBRARY
#ifdef IKFAST_CLIBRARY
#define IKFAST_API extern "C"
#else
#define IKFAST_API
#endif

#ifdef IKFAST_NAMESPACE
namespace IKFAST_NAMESPACE {
#endif

#ifdef IKFAST_REAL
typedef IKFAST_REAL IkReal;
#else
typedef double IkReal;
#endif

IKFAST_API bool ComputeIk(const IkReal *eetrans, const IkReal *eerot, const IkReal *pfree, ikfast::IkSolutionListBase<IkReal> &solutions);
IKFAST_API void ComputeFk(const IkReal *joints, IkReal *eetrans, IkReal *eerot);
IKFAST_API int GetNumFreeParameters();
#ifdef IKFAST_DOUBLE_OPENRAVE
IKFAST_API bool ComputeIk2(const IkReal *eetrans, const IkReal *eerot, const IkReal *pfree, ikfast::IkSolutionListBase<IkReal> &solutions, void *manipulator);
IKFAST_API const int *GetFreeIndices();
#else
IKFAST_API int *GetFreeParameters();
#endif
IKFAST_API int GetNumJoints();
IKFAST_API int GetIkRealSize();
IKFAST_API const char *GetIkFastVersion();
IKFAST_API int GetIkType();
IKFAST_API const char *GetKinematicsHash();

#ifdef IKFAST_NAMESPACE
}
#endif
#endif
