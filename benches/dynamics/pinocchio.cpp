// Pinocchio's calls for main.rs: each goes through all states, so that only they are timed.
#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/algorithm/crba.hpp>
#include <pinocchio/algorithm/joint-configuration.hpp>
#include <pinocchio/algorithm/model.hpp>
#include <pinocchio/algorithm/rnea-derivatives.hpp>
#include <pinocchio/algorithm/rnea.hpp>
#include <pinocchio/parsers/urdf.hpp>

#include <memory>
#include <string>
#include <vector>

using namespace pinocchio;
using Vector = Eigen::VectorXd;

struct Robot {
    Model model;
    std::unique_ptr<Data> data;
    std::vector<Vector> q, v, a;
};

extern "C" {

// A robot of a URDF without the joints of a list that ends with a null, and so many states; its root moves freely or not.
Robot *pinocchio_new(const char *file, const char *const *held, bool floats, int states)
{
    auto *robot = new Robot;
    Model whole;
    if (floats) {
        pinocchio::urdf::buildModel(file, JointModelFreeFlyer(), whole);
    } else {
        pinocchio::urdf::buildModel(file, whole);
    }
    std::vector<JointIndex> locked;
    for (; *held; ++held) {
        locked.push_back(whole.getJointId(*held));
    }
    robot->model = locked.empty() ? whole : buildReducedModel(whole, locked, neutral(whole));
    robot->data = std::make_unique<Data>(robot->model);
    std::srand(1);
    for (int i = 0; i < states; ++i) {
        Vector way = 1.5 * Vector::Random(robot->model.nv);
        robot->q.push_back(integrate(robot->model, neutral(robot->model), way));
        robot->v.push_back(Vector::Random(robot->model.nv));
        robot->a.push_back(Vector::Random(robot->model.nv));
    }
    return robot;
}

int pinocchio_freedoms(const Robot *robot)
{
    return robot->model.nv;
}

// 0 inverse, 1 gravity, 2 inertia, 3 coriolis, 4 forward, 5 derivatives, at all states; what came of it, so that nothing is left out.
double pinocchio_run(Robot *robot, int function)
{
    Model &m = robot->model;
    Data &d = *robot->data;
    double sum = 0;
    for (size_t i = 0; i < robot->q.size(); ++i) {
        const Vector &q = robot->q[i], &v = robot->v[i], &a = robot->a[i];
        switch (function) {
        case 0: sum += rnea(m, d, q, v, a)[0]; break;
        case 1: sum += computeGeneralizedGravity(m, d, q)[0]; break;
        case 2: sum += crba(m, d, q, Convention::WORLD)(0, 0); break;
        case 3: sum += computeCoriolisMatrix(m, d, q, v)(0, 0); break;
        case 4: sum += aba(m, d, q, v, a, Convention::LOCAL)[0]; break;
        case 6: sum += crba(m, d, q, Convention::LOCAL)(0, 0); break;
        case 7: sum += aba(m, d, q, v, a, Convention::WORLD)[0]; break;
        default: computeRNEADerivatives(m, d, q, v, a); sum += d.dtau_dq(0, 0); break;
        }
    }
    return sum;
}
}
