/*---------------------------------------------------------------------------*\
  =========                 |
  \\      /  F ield         | MSDD: multiscale data-driven heat conduction
   \\    /   O peration     |       in granular media
    \\  /    A nd           | for OpenFOAM
     \\/     M anipulation  |
-------------------------------------------------------------------------------
License
    SPDX-License-Identifier: GPL-3.0-or-later

    This program is free software: you can redistribute it and/or modify it
    under the terms of the GNU General Public License as published by the Free
    Software Foundation, either version 3 of the License, or (at your option)
    any later version. It comes without any warranty: see the file LICENSE.
\*---------------------------------------------------------------------------*/

#include "petscObjects.H"
#include "granularProperties.H"
#include "syncTools.H"
#include "globalIndex.H"
#include "OStringStream.H"

#include <cmath>
#include <cstdlib>
#include <dlfcn.h>

// * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Numbers of nodes up to which factorising is faster than multigrid
static const label smallPlane = 10000;
static const label smallSolid = 3000;

static const keyTable solverKeys
(
    "solvers.equilibrium",
    {
        {
            "solver",
            "method for matrices that are not symmetric; symmetric ones (all"
            " with `law elastic`) are solved by conjugate gradients."
            " `PBiCGStab` needs less memory", "-", "GMRES, PBiCGStab", "GMRES"
        },
        {
            "preconditioner",
            "`Cholesky`: the factorised matrix of a uniform medium, fastest on"
            " small meshes; on several processes two runs may differ in their"
            " last digits. `AMG`: algebraic multigrid that uses the rigid"
            " motions. `componentAMG`: multigrid for each component of the"
            " displacement; in space it needs a third of the memory, but many"
            " more iterations for slender bodies", "-",
            "AMG, componentAMG, Cholesky",
            "`Cholesky` on one process up to 10 000 nodes (3 000 in space),"
            " else `AMG` (in space `componentAMG`)"
        },
        {
            "relTol",
            "residual of the linear equations of a Newton iteration, relative"
            " to the imbalance", "-", "1e-14 to 0.9",
            "0.3; of spheres 0.1; with `law elastic` 1e-6"
        },
        {
            "maxIter", "iterations for that", "-", "1 to 100000",
            "30; with `law elastic` 1000"
        },
        {
            "petsc", "options of PETSc, without the dash", "-",
            "a dictionary", "empty"
        }
    }
);

//- Start PETSc, once in a process
static void startPetsc()
{
    PetscBool started = PETSC_FALSE;
    check(PetscInitialized(&started));
    if (started)
    {
        return;
    }
    if (!Pstream::parRun())
    {
        // A process by itself needs no daemon and no network: without these,
        // Open MPI takes 0.3 s to start
        setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
        setenv("OMPI_MCA_pml", "ob1", 0);
        setenv("OMPI_MCA_btl", "self", 0);
        // Nor a folder for temporary files, which has the same name for all
        // such processes: one that ends would remove it under another that
        // starts, which then fails
        setenv("OMPI_MCA_orte_create_session_dirs", "0", 0);
    }
    // The blocks of linear algebra here are too small for threads, which would
    // only wait for each other
    using setter = void(*)(int);
    if
    (
        const auto threads = reinterpret_cast<setter>
        (
            dlsym(RTLD_DEFAULT, "openblas_set_num_threads")
        )
    )
    {
        threads(1);
    }
    // Debian's BLAS takes twice as long for the solution by blocks
    check(PetscOptionsSetValue(nullptr, "-mat_cholmod_factor", "simplicial"));
    // The signals belong to OpenFOAM
    check(PetscOptionsSetValue(nullptr, "-no_signal_handler", nullptr));
    // The same bytes in each run on the same number of processes
    check(PetscOptionsSetValue(nullptr, "-matstash_legacy", nullptr));
    check(PetscOptionsSetValue(nullptr, "-matstash_reproduce", nullptr));
    if (Pstream::parRun())
    {
        check(PetscOptionsSetValue(nullptr, "-matptap_via", "allatonce"));
    }
    check(PetscInitializeNoArguments());
}


//- Callbacks of PETSc
static PetscErrorCode shellMultiply(Mat A, Vec x, Vec y)
{
    equilibriumSolver* self;
    MatShellGetContext(A, &self);
    const double* from;
    double* to;
    VecGetArrayRead(x, &from);
    VecGetArray(y, &to);
    self->multiply(from, to);
    VecRestoreArrayRead(x, &from);
    VecRestoreArray(y, &to);
    return 0;
}


static PetscErrorCode shellPrecondition(PC pc, Vec x, Vec y)
{
    equilibriumSolver* self;
    PCShellGetContext(pc, &self);
    const double* from;
    double* to;
    VecGetArrayRead(x, &from);
    VecGetArray(y, &to);
    self->precondition(from, to);
    VecRestoreArrayRead(x, &from);
    VecRestoreArray(y, &to);
    return 0;
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::equilibriumSolver::equilibriumSolver
(
    const elementMesh& mesh,
    const wallConditions& walls,
    const stressLaw& law,
    const elementMesh::shapes& reference,
    const scalar stabilisation,
    const scalarField& uniformDiagonal,
    const product& multiply
)
:
    mesh_(mesh),
    walls_(walls),
    multiply_(multiply),
    unfitted_(stabilisation),
    lambda_(law.lambda()),
    shear_(law.shear()),
    mediumDiagonal_(uniformDiagonal),
    scaling_(uniformDiagonal.size(), 1),
    in_(uniformDiagonal.size(), Zero),
    out_(uniformDiagonal.size(), Zero),
    petsc_(new objects)
{
    const dictionary& solvers =
        mesh.mesh().solutionDict().subOrEmptyDict("solvers");
    const dictionary controls
    (
        solvers.found("equilibrium", keyType::LITERAL)
      ? solvers.subDict("equilibrium")
      : dictionary()
    );
    solverKeys.check(controls);
    solver_ = solverKeys.choice(controls, "solver");
    const word preconditioner
    (
        solverKeys.choice
        (
            controls,
            "preconditioner",
            !Pstream::parRun()
         && mesh.size() < (mesh.dim() == 2 ? smallPlane : smallSolid)
          ? "Cholesky"
          : mesh.dim() == 3 ? "componentAMG" : "AMG"
        )
    );
    relTol_ = solverKeys.number(controls, "relTol", law.linearResidual());
    maxIter_ = label
    (
        solverKeys.number(controls, "maxIter", law.elastic() ? 1000 : 30)
    );

    forAll(walls.constrainedNodes(), i)
    {
        bool aligned = true;
        const label dim = mesh.dim();
        for (label k = 0; k < dim*dim; ++k)
        {
            const scalar e = mag(walls.basis()[dim*dim*i + k]);
            aligned = aligned && (e == 0 || e == 1);
        }
        if (!aligned)
        {
            slanted_.append(walls.constrainedNodes()[i]);
        }
    }

    const quietArithmetic quiet;
    startPetsc();
    for (const entry& option : controls.subOrEmptyDict("petsc"))
    {
        OStringStream text;
        for (const token& part : option.stream())
        {
            text<< part;
        }
        const string value(text.str());
        check
        (
            PetscOptionsSetValue
            (
                nullptr,
                ("-" + word(option.keyword())).c_str(),
                value.c_str()
            )
        );
    }
    findNumbers();

    const bool all = preconditioner != "componentAMG";
    const label parts = all ? 1 : mesh.dim();
    objects& p = *petsc_;
    p.matrices.resize(parts, nullptr);
    p.preconditioners.resize(parts, nullptr);
    p.from.resize(parts, nullptr);
    p.to.resize(parts, nullptr);
    for (label part = 0; part < parts; ++part)
    {
        assemble(reference, all ? -1 : part);
    }
    makePreconditioner(preconditioner);

    const label rows = mesh.dim()*label(mesh.owned().count());
    check(VecCreate(PETSC_COMM_WORLD, &p.r));
    check(VecSetSizes(p.r, rows, PETSC_DECIDE));
    check(VecSetFromOptions(p.r));
    check(VecDuplicate(p.r, &p.d));
    check
    (
        MatCreateShell
        (
            PETSC_COMM_WORLD, rows, rows, PETSC_DECIDE, PETSC_DECIDE, this,
            &p.shell
        )
    );
    check
    (
        MatShellSetOperation
        (
            p.shell, MATOP_MULT, reinterpret_cast<void(*)(void)>(shellMultiply)
        )
    );
}


Foam::equilibriumSolver::~equilibriumSolver()
{
    const quietArithmetic quiet;
    objects& p = *petsc_;
    forAll(p.matrices, i)
    {
        PCDestroy(&p.preconditioners[i]);
        MatDestroy(&p.matrices[i]);
        VecDestroy(&p.from[i]);
        VecDestroy(&p.to[i]);
    }
    KSPDestroy(&p.solvers[0]);
    KSPDestroy(&p.solvers[1]);
    MatDestroy(&p.shell);
    VecDestroy(&p.r);
    VecDestroy(&p.d);
    // PETSc itself stays: it cannot be started twice in a process
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::equilibriumSolver::objects& Foam::equilibriumSolver::withSolver
(
    const bool symmetric
)
{
    objects& p = *petsc_;
    KSP& solver = p.solvers[symmetric];
    if (solver)
    {
        return p;
    }
    check(KSPCreate(PETSC_COMM_WORLD, &solver));
    check(KSPSetOptionsPrefix(solver, "equilibrium_"));
    check(KSPSetOperators(solver, p.shell, p.shell));
    check
    (
        KSPSetType
        (
            solver,
            symmetric ? KSPCG : solver_ == "GMRES" ? KSPGMRES : KSPBCGS
        )
    );
    if (!symmetric)
    {
        check(KSPSetPCSide(solver, PC_RIGHT));
    }
    check(KSPSetNormType(solver, KSP_NORM_UNPRECONDITIONED));
    check(KSPSetTolerances(solver, relTol_, 0, 1e30, maxIter_));
    PC shell;
    check(KSPGetPC(solver, &shell));
    check(PCSetType(shell, PCSHELL));
    check(PCShellSetContext(shell, this));
    check(PCShellSetApply(shell, shellPrecondition));
    check(KSPSetFromOptions(solver));
    return p;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::equilibriumSolver::endPetsc()
{
    PetscBool started = PETSC_FALSE, ended = PETSC_FALSE;
    check(PetscInitialized(&started));
    check(PetscFinalized(&ended));
    if (started && !ended)
    {
        const quietArithmetic quiet;
        check(PetscFinalize());
    }
}


void Foam::equilibriumSolver::multiply(const double* from, double* to) const
{
    toField(from, in_);
    multiply_(in_, out_);
    toVector(out_, to);
}


Foam::label Foam::equilibriumSolver::solve
(
    const bool symmetric,
    const scalarField& diagonal,
    const scalarField& r,
    scalarField& d,
    const scalar mostLeft
)
{
    const quietArithmetic quiet;
    objects& p = withSolver(symmetric);
    forAll(scaling_, i)
    {
        scaling_[i] = std::sqrt(mediumDiagonal_[i]/diagonal[i]);
    }
    // The same for all components of a node that a slanted wall holds, so that
    // none of them becomes one that is held
    const label dim = mesh_.dim();
    for (const label node : slanted_)
    {
        scalar up = 0, down = 0;
        for (label i = dim*node; i < dim*(node + 1); ++i)
        {
            up += mediumDiagonal_[i];
            down += diagonal[i];
        }
        for (label i = dim*node; i < dim*(node + 1); ++i)
        {
            scaling_[i] = std::sqrt(up/down);
        }
    }
    double* x;
    check(VecGetArray(p.r, &x));
    toVector(r, x);
    check(VecRestoreArray(p.r, &x));
    KSP& solver = p.solvers[symmetric];
    PetscReal relTol, absTol, most;
    PetscInt maxIter;
    check(KSPGetTolerances(solver, &relTol, &absTol, &most, &maxIter));
    const scalar enough = min(relTol, mostLeft);
    check(KSPSetTolerances(solver, enough, absTol, most, maxIter));
    check(KSPSolve(solver, p.r, p.d));
    check(KSPSetTolerances(solver, relTol, absTol, most, maxIter));
    const double* y;
    check(VecGetArrayRead(p.d, &y));
    toField(y, d);
    check(VecRestoreArrayRead(p.d, &y));
    PetscInt iterations;
    check(KSPGetIterationNumber(solver, &iterations));
    return
        symmetric || solver_ == "GMRES" ? iterations : 2*iterations;
}


// ************************************************************************* //
